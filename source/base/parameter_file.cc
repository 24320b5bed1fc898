// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/input_file.h>
#include <fiberloom/base/parameter_file.h>

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string.hpp>

#include <algorithm>
#include <charconv>
#include <sstream>

namespace fiberloom
{
  namespace
  {
    // The longest lists of points are far shorter.
    constexpr std::uintmax_t most_bytes = 200000000;

    // Of sections in each other; those that there are take two.
    constexpr std::size_t deepest = 10;

    // Of one kind that are told.
    constexpr std::size_t most_notes = 10;

    std::string
    read_text(const std::string &name)
    {
      try
        {
          return read_input_file(name, most_bytes);
        }
      catch (const InputError &error)
        {
          throw InputError(name + ": " + error.what());
        }
    }

    /** Without comment, with single blanks, as the parser sees the line. */
    std::string
    normalize(const std::string &line)
    {
      std::size_t comment = line.find('#');
      while (comment != std::string::npos && comment > 0 &&
             line[comment - 1] == '\\')
        comment = line.find('#', comment + 1);
      std::istringstream in(line.substr(0, comment));
      std::string        normalized;
      for (std::string word; in >> word;)
        normalized += (normalized.empty() ? "" : " ") + word;
      return normalized;
    }

    /** Takes @p keyword and a blank off the front of a line. No regular
     * expression: those of the standard library exhaust the stack on long
     * lines. */
    bool
    take_keyword(std::string &line, const std::string &keyword)
    {
      for (const std::string &word :
           {keyword, boost::algorithm::to_upper_copy(keyword)})
        if (boost::algorithm::starts_with(line, word + " "))
          {
            line.erase(0, word.size() + 1);
            return true;
          }
      return false;
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
    const bool has_sign = line.find('=') != std::string::npos;
    if (has_sign && take_keyword(line, "set"))
      {
        const std::string section = path_of(open_sections);
        const std::size_t after   = line.find('=') + 1;
        statement.kind            = Kind::set;
        statement.path            = (section.empty() ? "" : section + "/") +
                         dealii::Utilities::trim(line.substr(0, after - 1));
        statement.value = dealii::Utilities::trim(line.substr(after));
      }
    else if (take_keyword(line, "subsection"))
      {
        if (open_sections.size() == deepest)
          throw InputError(location(statement.first_line) +
                           ": a section within " + std::to_string(deepest) +
                           " others; allowed: those that --print-parameters "
                           "lists");
        open_sections.push_back(line);
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
    else if (take_keyword(line, "include"))
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
    if (std::none_of(statements.begin(),
                     statements.end(),
                     [](const Statement &s) { return s.kind == Kind::set; }))
      throw InputError(name +
                       ": sets no entry; allowed: at least one line 'set "
                       "ENTRY = VALUE', see --print-parameters");
  }

  std::vector<std::string>
  ParameterFile::notes() const
  {
    std::map<std::string, unsigned int> lines;
    std::vector<std::string>            notes;
    std::size_t                         n_more = 0;
    for (const Statement &statement : statements)
      {
        if (statement.kind != Kind::set)
          continue;
        const auto [former, is_new] =
          lines.insert({statement.path, statement.first_line});
        if (is_new)
          continue;
        if (notes.size() < most_notes)
          notes.push_back(location(statement.first_line) + ": " +
                          statement.path + " is set in line " +
                          std::to_string(former->second) +
                          ", too; the later one counts");
        else
          ++n_more;
        former->second = statement.first_line;
      }
    if (n_more > 0)
      notes.push_back(name + ": " + std::to_string(n_more) +
                      " more entries are set twice");
    return notes;
  }

  std::string
  ParameterFile::explain(const dealii::ExceptionBase &error,
                         const ParameterCatalogue    &catalogue) const
  {
    // the parser gives line and reason only as a sentence
    const std::string sentence = one_line(error);
    const std::string before   = "Line <";
    const std::size_t place    = sentence.find(before);
    unsigned int      line     = 0;
    if (place != std::string::npos)
      std::from_chars(sentence.data() + place + before.size(),
                      sentence.data() + sentence.size(),
                      line);
    const auto statement =
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
