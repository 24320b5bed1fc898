// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>

#include <fiberloom/output/curves.h>

#include <boost/algorithm/string/classification.hpp>
#include <boost/algorithm/string/split.hpp>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace fiberloom
{
  namespace
  {
    constexpr unsigned int n_fixed_columns = 3;

    std::string
    curve_cell(const double value)
    {
      if (!std::isfinite(value))
        return "";
      std::ostringstream out;
      out << std::setprecision(15) << value;
      return out.str();
    }

    std::vector<std::string>
    split_line(const std::string &line)
    {
      std::vector<std::string> cells;
      boost::algorithm::split(cells, line, boost::is_any_of(","));
      return cells;
    }

    LoadingCurve::Row
    parse_row(const std::string &line)
    {
      const auto cells = split_line(line);
      try
        {
          LoadingCurve::Row row;
          row.stage     = cells.at(0);
          row.increment = std::stoul(cells.at(1));
          row.load      = std::stod(cells.at(2));
          row.cells.assign(cells.begin() + n_fixed_columns, cells.end());
          return row;
        }
      catch (const std::exception &)
        {
          throw InputError("loading_curve.csv: not a row of a loading curve: " +
                           line);
        }
    }

    /**
     * A file has the names of stages only, and may begin with a later one; a
     * repeated stage starts again at 1.
     */
    void
    number_stages(std::vector<LoadingCurve::Row> &rows,
                  const std::vector<std::string> &stages)
    {
      unsigned int index = 0;
      for (std::size_t i = 0; i < rows.size(); ++i)
        {
          if (i > 0 && (rows[i].stage != rows[i - 1].stage ||
                        rows[i].increment <= rows[i - 1].increment))
            ++index;
          while (index < stages.size() && stages[index] != rows[i].stage)
            ++index;
          rows[i].stage_index = index;
        }
    }
  } // namespace



  void
  LoadingCurve::append(const unsigned int stage_index,
                       const std::string &stage,
                       const unsigned int increment,
                       const double       load,
                       const CurveRow    &values)
  {
    all_rows.erase(std::remove_if(all_rows.begin(),
                                  all_rows.end(),
                                  [&](const Row &row) {
                                    return row.stage_index == stage_index &&
                                           row.increment == increment;
                                  }),
                   all_rows.end());

    Row row{stage_index, stage, increment, load, {}};
    for (const auto &[name, value] : values)
      {
        const unsigned int c = column(name);
        row.cells.resize(std::max<std::size_t>(row.cells.size(), c + 1));
        row.cells[c] = curve_cell(value);
      }
    all_rows.push_back(row);
  }



  void
  LoadingCurve::continue_from(const std::string              &text,
                              const std::vector<std::string> &stages,
                              const unsigned int              stage_index,
                              const unsigned int              increment)
  {
    std::istringstream input(text);
    std::string        line;
    if (!std::getline(input, line) ||
        line.rfind("stage,increment,load", 0) != 0)
      throw InputError("loading_curve.csv: not the header of a loading curve");

    const auto header = split_line(line);
    column_names.assign(header.begin() + n_fixed_columns, header.end());
    all_rows.clear();
    while (std::getline(input, line))
      if (!line.empty())
        all_rows.push_back(parse_row(line));
    number_stages(all_rows, stages);

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
  LoadingCurve::str() const
  {
    std::ostringstream out;
    out << "stage,increment,load";
    for (const auto &name : column_names)
      out << "," << name;
    out << "\n";
    for (const Row &row : all_rows)
      {
        out << row.stage << "," << row.increment << "," << curve_cell(row.load);
        for (std::size_t c = 0; c < column_names.size(); ++c)
          out << "," << (c < row.cells.size() ? row.cells[c] : "");
        out << "\n";
      }
    return out.str();
  }



  std::vector<double>
  LoadingCurve::values(const unsigned int stage_index,
                       const unsigned int column) const
  {
    std::vector<double> result;
    for (const Row &row : all_rows)
      if (row.stage_index == stage_index)
        result.push_back(column < row.cells.size() &&
                             !row.cells[column].empty() ?
                           std::stod(row.cells[column]) :
                           std::numeric_limits<double>::quiet_NaN());
    return result;
  }



  std::vector<double>
  LoadingCurve::loads(const unsigned int stage_index) const
  {
    std::vector<double> result;
    for (const Row &row : all_rows)
      if (row.stage_index == stage_index)
        result.push_back(row.load);
    return result;
  }



  unsigned int
  LoadingCurve::column(const std::string &name)
  {
    const auto found =
      std::find(column_names.begin(), column_names.end(), name);
    const unsigned int index = found - column_names.begin();
    if (found == column_names.end())
      column_names.push_back(name);
    return index;
  }
} // namespace fiberloom
