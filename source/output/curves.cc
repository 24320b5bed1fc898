// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/output/curves.h>

#include <algorithm>
#include <cstdlib>
#include <limits>

namespace fiberloom
{
  IncrementTable::Place
  place_of(const IncrementReport &report)
  {
    return {report.state.stage,
            report.stage,
            report.state.increment,
            report.state.load};
  }



  LoadingCurve::LoadingCurve()
    : IncrementTable("loading_curve.csv")
  {}



  void
  LoadingCurve::append(const Place &place, const CurveRow &values)
  {
    Cells cells;
    for (const auto &[column, value] : values)
      {
        describe(column);
        cells.emplace_back(column.heading(), table_cell(value));
      }
    IncrementTable::append(place, "", cells);
  }



  void
  LoadingCurve::continue_columns(const std::vector<Column> &former)
  {
    for (const Column &column : former)
      describe(column);
  }



  void
  LoadingCurve::describe(const Column &column)
  {
    if (std::none_of(described.begin(),
                     described.end(),
                     [&column](const Column &known) {
                       return known.name == column.name &&
                              known.quantity == column.quantity;
                     }))
      described.push_back(column);
  }



  std::vector<double>
  LoadingCurve::values(const unsigned int stage_index,
                       const Column      &column) const
  {
    const unsigned int c =
      std::find(columns().begin(), columns().end(), column.heading()) -
      columns().begin();
    std::vector<double> result;
    for (const Row &row : rows())
      if (row.stage_index == stage_index)
        result.push_back(c < row.cells.size() && !row.cells[c].empty() ?
                           std::strtod(row.cells[c].c_str(), nullptr) :
                           std::numeric_limits<double>::quiet_NaN());
    return result;
  }



  std::vector<double>
  LoadingCurve::loads(const unsigned int stage_index) const
  {
    std::vector<double> result;
    for (const Row &row : rows())
      if (row.stage_index == stage_index)
        result.push_back(row.load);
    return result;
  }
} // namespace fiberloom
