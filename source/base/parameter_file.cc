// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/parameter_file.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

namespace fiberloom
{
  namespace
  {
    std::string
    read_text(const std::string &name)
    {
      if (std::filesystem::is_directory(name))
        throw InputError(name + ": is a directory, not a parameter file");
      std::ifstream     in(name);
      std::stringstream text;
      if (!in)
        throw InputError(name + ": cannot be read: " + std::strerror(errno));
      text << in.rdbuf();
      return text.str();
    }

    /** Without comment, with single blanks, as the parser sees the line. */
    std::string
    normalize(std::string line)
    {
      line = std::regex_replace(line, std::regex("(^|[^\\\\])#.*"), "$1");
      line = std::regex_replace(line, std::regex("\\s+"), " ");
      return std::regex_replace(line, std::regex("^ | $"), "");
    }

    std::string
    path_of(const std::vector<std::string> &sections)
    {
      std::string path;
      for (const std::string &section : sections)
        path += (path.empty() ? "" : "/") + section;
      return path;
    }
  } // namespace

  ParameterFile::ParameterFile(const std::string &name)
    : name(name)
    , text(read_text(name))
  {
    scan();
  }

  void
  ParameterFile::scan()
  {
    std::istringstream       in(text);
    std::vector<std::string> open_sections;
    std::string              line, joined;
    unsigned int             first_line = 1;
    for (unsigned int number = 1; std::getline(in, line); ++number)
      {
        const bool goes_on = !line.empty() && line.back() == '\\';
        if (goes_on)
          line.pop_back();
        joined += line;
        if (goes_on)
          continue;
        scan_statement(normalize(joined),
                       {first_line, number, Kind::other, "", ""},
                       open_sections);
        joined.clear();
        first_line = number + 1;
      }

    if (open_sections.empty())
      return;
    const std::string path = path_of(open_sections);
    const auto        opened =
      std::find_if(statements.rbegin(),
                   statements.rend(),
                   [&path](const Statement &s) {
                     return s.kind == Kind::subsection && s.path == path;
                   });
    throw InputError(location(opened->first_line) + ": subsection " + path +
                     " has no 'end'");
  }

  void
  ParameterFile::scan_statement(std::string               line,
                                Statement                 statement,
                                std::vector<std::string> &open_sections)
  {
    static const std::regex set("(?:set|SET) ([^=]*?) ?= ?(.*)");
    static const std::regex subsection("(?:subsection|SUBSECTION) (.*)");
    static const std::regex include("(?:include|INCLUDE) .*");
    std::smatch             match;

    if (std::regex_match(line, match, set))
      {
        const std::string section = path_of(open_sections);
        statement.kind            = Kind::set;
        statement.path  = (section.empty() ? "" : section + "/") + match.str(1);
        statement.value = match.str(2);
      }
    else if (std::regex_match(line, match, subsection))
      {
        open_sections.push_back(match.str(1));
        statement.kind = Kind::subsection;
        statement.path = path_of(open_sections);
      }
    else if (line == "end" || line == "END")
      {
        if (open_sections.empty())
          throw InputError(location(statement.first_line) +
                           ": 'end' without a subsection to leave");
        open_sections.pop_back();
        statement.kind = Kind::end;
      }
    else if (std::regex_match(line, include))
      throw InputError(location(statement.first_line) +
                       ": 'include' is not supported; allowed: set, "
                       "subsection, end");
    statements.push_back(statement);
  }

  std::string
  ParameterFile::location(const unsigned int line) const
  {
    return name + ", line " + std::to_string(line);
  }

  std::string
  ParameterFile::value(const std::string &path,
                       const std::string &otherwise) const
  {
    const auto last =
      std::find_if(statements.rbegin(),
                   statements.rend(),
                   [&path](const Statement &s) {
                     return s.kind == Kind::set && s.path == path;
                   });
    return last == statements.rend() ? otherwise : last->value;
  }

  std::map<std::string, std::string>
  ParameterFile::locations() const
  {
    std::map<std::string, std::string> found;
    for (const Statement &statement : statements)
      if (statement.kind == Kind::set)
        found[statement.path] = location(statement.first_line);
    return found;
  }

  void
  ParameterFile::parse_into(ParameterCatalogue &catalogue) const
  {
    std::istringstream in(text);
    try
      {
        catalogue.handler().parse_input(in, name);
      }
    catch (const dealii::ExceptionBase &error)
      {
        throw InputError(explain(error, catalogue));
      }
  }

  std::string
  ParameterFile::explain(const dealii::ExceptionBase &error,
                         const ParameterCatalogue    &catalogue) const
  {
    // the parser gives line and reason only as a sentence
    const std::string sentence = one_line(error);
    std::smatch       match;
    if (!std::regex_search(sentence, match, std::regex("Line <(\\d+)>")))
      return name + ": " + sentence;

    const unsigned int line = std::stoul(match.str(1));
    const auto         statement =
      std::find_if(statements.begin(),
                   statements.end(),
                   [line](const Statement &s) {
                     return s.first_line <= line && line <= s.last_line;
                   });
    if (statement == statements.end())
      return name + ": " + sentence;

    const std::string  where = location(statement->first_line) + ": ";
    const std::string &path  = statement->path;
    if (statement->kind == Kind::subsection && !catalogue.has_section(path))
      return where + catalogue.explain_unknown_section(path);
    if (statement->kind == Kind::set)
      {
        const auto *entry = catalogue.find(path);
        return where + (entry == nullptr ?
                          catalogue.explain_unknown_entry(path) :
                          path + " = " + statement->value +
                            " is not allowed; allowed: " + entry->allowed);
      }
    return where +
           "neither 'set ENTRY = VALUE' nor 'subsection NAME' nor 'end'";
  }
} // namespace fiberloom
