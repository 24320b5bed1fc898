// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_increment_table_h
#define fiberloom_output_increment_table_h

#include <string>
#include <utility>
#include <vector>

namespace fiberloom
{
  /** Text of a number to 15 digits, empty where it is not finite. */
  std::string
  table_cell(const double value);

  /**
   * A file of comma-separated values that grows with the accepted increments:
   * stage, increment and load, the key where an increment has several rows,
   * then the union of the columns of all rows in the order of their appearance;
   * cells that a row does not know are empty.
   */
  class IncrementTable
  {
  public:
    /** The stage, increment and load that a row belongs to. */
    struct Place
    {
      unsigned int stage_index; // position in the scene
      std::string  stage;
      unsigned int increment;
      double       load;
    };

    /** One line of the file. */
    struct Row : Place
    {
      std::string              key;
      std::vector<std::string> cells; // as in columns, possibly fewer
    };

    /** Columns in order, name and text. */
    using Cells = std::vector<std::pair<std::string, std::string>>;

    /**
     * @p file names the table in errors. With several rows an increment,
     * @p key_column is the heading of what tells them apart.
     */
    explicit IncrementTable(const std::string &file,
                            const std::string &key_column = "");

    /** Adds a row; one of the same stage, increment and key is replaced. */
    void
    append(const Place &place, const std::string &key, const Cells &cells);

    /**
     * Takes up the rows of the text of a former file of a scene with @p stages
     * up to @p increment of stage @p stage_index ; those beyond are forgotten.
     * Throws InputError if @p text is no such file.
     */
    void
    continue_from(const std::string              &text,
                  const std::vector<std::string> &stages,
                  const unsigned int              stage_index,
                  const unsigned int              increment);

    /** Text of the file. */
    std::string
    str() const;

    const std::string &
    file() const
    {
      return file_name;
    }

    const std::vector<std::string> &
    columns() const
    {
      return column_names;
    }

    const std::vector<Row> &
    rows() const
    {
      return all_rows;
    }

  private:
    std::string
    fixed_header() const;

    Row
    parse_row(const std::string &line) const;

    void
    number_stages(const std::vector<std::string> &stages);

    unsigned int
    column(const std::string &name);

    std::string              file_name, key_column;
    std::vector<std::string> column_names;
    std::vector<Row>         all_rows;
  };
} // namespace fiberloom

#endif
