// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/output/curves.h>

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
    for (const auto &[name, value] : values)
      cells.emplace_back(name, table_cell(value));
    IncrementTable::append(place, "", cells);
  }



  std::vector<double>
  LoadingCurve::values(const unsigned int stage_index,
                       const unsigned int column) const
  {
    std::vector<double> result;
    for (const Row &row : rows())
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
    for (const Row &row : rows())
      if (row.stage_index == stage_index)
        result.push_back(row.load);
    return result;
  }
} // namespace fiberloom
