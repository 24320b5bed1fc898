// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_base_parameter_file_h
#define fiberloom_base_parameter_file_h

#include <fiberloom/base/parameter_catalogue.h>

#include <map>
#include <string>
#include <vector>

namespace fiberloom
{
  /**
   * The text of a parameter file, which knows where each entry stands in it so
   * that errors can be explained.
   */
  class ParameterFile
  {
  public:
    /**
     * Reads the file. Throws InputError if that fails, if a subsection has no
     * end or lies deeper than any that there is, and for 'include', whose lines
     * could not be named.
     */
    explicit ParameterFile(const std::string &name);

    /** Throws InputError with one line that says where and what is allowed,
     * also where nothing is set. */
    void
    parse_into(ParameterCatalogue &catalogue) const;

    /** Value of the last "set" of the entry @p path , or @p otherwise . */
    std::string
    value(const std::string &path, const std::string &otherwise) const;

    /**
     * The place "FILE, line N" of each entry that is set, by the entry's path.
     */
    std::map<std::string, std::string>
    locations() const;

    /** A line for each entry that is set twice. */
    std::vector<std::string>
    notes() const;

  private:
    enum class Kind
    {
      set,
      subsection,
      end,
      other
    };

    struct Statement
    {
      unsigned int first_line, last_line; // of the file, from 1
      Kind         kind;
      std::string  path; // of the entry or subsection
      std::string  value;
    };

    std::string            name;
    std::string            text;
    std::vector<Statement> statements;

    void
    scan();

    void
    scan_statement(std::string               line,
                   Statement                 statement,
                   std::vector<std::string> &open_sections);

    std::string
    location(const unsigned int line) const;

    std::string
    explain(const dealii::ExceptionBase &error,
            const ParameterCatalogue    &catalogue) const;
  };
} // namespace fiberloom

#endif
