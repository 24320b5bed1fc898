// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>

#include <fiberloom/output/increment_table.h>

#include <boost/algorithm/string/classification.hpp>
#include <boost/algorithm/string/split.hpp>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace fiberloom
{
  namespace
  {
    std::vector<std::string>
    split_line(const std::string &line)
    {
      std::vector<std::string> cells;
      boost::algorithm::split(cells, line, boost::is_any_of(","));
      return cells;
    }
  } // namespace



  std::string
  table_cell(const double value)
  {
    if (!std::isfinite(value))
      return "";
    std::ostringstream out;
    out << std::setprecision(15) << value;
    return out.str();
  }



  IncrementTable::IncrementTable(const std::string &file,
                                 const std::string &key_column)
    : file_name(file)
    , key_column(key_column)
  {}



  void
  IncrementTable::append(const Place       &place,
                         const std::string &key,
                         const Cells       &cells)
  {
    all_rows.erase(std::remove_if(all_rows.begin(),
                                  all_rows.end(),
                                  [&](const Row &row) {
                                    return row.stage_index ==
                                             place.stage_index &&
                                           row.increment == place.increment &&
                                           row.key == key;
                                  }),
                   all_rows.end());

    Row row{place, key, {}};
    for (const auto &[name, text] : cells)
      {
        const unsigned int c = column(name);
        row.cells.resize(std::max<std::size_t>(row.cells.size(), c + 1));
        row.cells[c] = text;
      }
    all_rows.push_back(row);
  }



  void
  IncrementTable::continue_from(const std::string              &text,
                                const std::vector<std::string> &stages,
                                const unsigned int              stage_index,
                                const unsigned int              increment)
  {
    std::istringstream input(text);
    std::string        line;
    if (!std::getline(input, line) || line.rfind(fixed_header(), 0) != 0)
      throw InputError(file_name + ": does not begin with " + fixed_header());

    const auto header = split_line(line);
    column_names.assign(header.begin() + split_line(fixed_header()).size(),
                        header.end());
    all_rows.clear();
    while (std::getline(input, line))
      if (!line.empty())
        all_rows.push_back(parse_row(line));
    number_stages(stages);

    all_rows.erase(std::remove_if(all_rows.begin(),
                                  all_rows.end(),
                                  [&](const Row &row) {
                                    return row.stage_index > stage_index ||
                                           (row.stage_index == stage_index &&
                                            row.increment > increment);
                                  }),
                   all_rows.end());
  }



  std::string
  IncrementTable::str() const
  {
    std::ostringstream out;
    out << fixed_header();
    for (const auto &name : column_names)
      out << "," << name;
    out << "\n";
    for (const Row &row : all_rows)
      {
        out << row.stage << "," << row.increment << "," << table_cell(row.load);
        if (!key_column.empty())
          out << "," << row.key;
        for (std::size_t c = 0; c < column_names.size(); ++c)
          out << "," << (c < row.cells.size() ? row.cells[c] : "");
        out << "\n";
      }
    return out.str();
  }



  std::string
  IncrementTable::fixed_header() const
  {
    return "stage,increment,load" +
           (key_column.empty() ? "" : "," + key_column);
  }



  IncrementTable::Row
  IncrementTable::parse_row(const std::string &line) const
  {
    const auto cells = split_line(line);
    try
      {
        Row          row;
        unsigned int c = 0;
        row.stage      = cells.at(c++);
        row.increment  = std::stoul(cells.at(c++));
        row.load       = std::stod(cells.at(c++));
        if (!key_column.empty())
          row.key = cells.at(c++);
        row.cells.assign(cells.begin() + c, cells.end());
        return row;
      }
    catch (const std::exception &)
      {
        throw InputError(file_name + ": not a row of this file: " + line);
      }
  }



  void
  IncrementTable::number_stages(const std::vector<std::string> &stages)
  {
    // A file has the names of stages only, and may begin with a later one; a
    // repeated stage starts again at 1. An increment ends where its first key
    // comes again.
    unsigned int index = 0;
    std::size_t  first = 0;
    for (std::size_t i = 0; i < all_rows.size(); ++i)
      {
        Row       &row            = all_rows[i];
        const Row &before         = all_rows[first];
        const bool same_stage     = row.stage == before.stage;
        const bool same_increment = same_stage && row.key != before.key &&
                                    row.increment == before.increment;
        if (!same_increment)
          {
            if (i > 0 && (!same_stage || row.increment <= before.increment))
              ++index;
            first = i;
          }
        while (index < stages.size() && stages[index] != row.stage)
          ++index;
        row.stage_index = index;
      }
  }



  unsigned int
  IncrementTable::column(const std::string &name)
  {
    const auto found =
      std::find(column_names.begin(), column_names.end(), name);
    const unsigned int index = found - column_names.begin();
    if (found == column_names.end())
      column_names.push_back(name);
    return index;
  }
} // namespace fiberloom
