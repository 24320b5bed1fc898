// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_curves_h
#define fiberloom_output_curves_h

#include <fiberloom/stages/stage.h>

#include <fiberloom/output/increment_table.h>

#include <limits>
#include <string>
#include <vector>

namespace fiberloom
{
  /** The place of the rows that tables get about @p report . */
  IncrementTable::Place
  place_of(const IncrementReport &report);

  /** The rows of loading_curve.csv, one for each accepted increment, and one
   * for the state in which a test begins. */
  class LoadingCurve : public IncrementTable
  {
  public:
    LoadingCurve();

    /** Values that are not finite are left empty. */
    void
    append(const Place &place, const CurveRow &values);

    /** The columns of a former curve, of which continue_from() knows the
     * headings only. */
    void
    continue_columns(const std::vector<Column> &former);

    /** All columns in the order of their appearance. */
    const std::vector<Column> &
    described_columns() const
    {
      return described;
    }

    /** The values of a column over the rows of a stage, NaN where empty. */
    std::vector<double>
    values(const unsigned int stage_index, const Column &column) const;

    /** Loads of the rows of a stage. */
    std::vector<double>
    loads(const unsigned int stage_index) const;

  private:
    void
    describe(const Column &column);

    std::vector<Column> described;
  };

  /**
   * The loading curve of a stage as SVG: its responses of one quantity, six at
   * most and none that stays zero, over the deformation that varies most, else
   * over the load. Moments are drawn before forces over an angle, after them
   * over all others. Empty when there are not two points to draw. A
   * finite @p error is drawn as a band around the curves, over the largest of
   * their values.
   */
  std::string
  curve_picture(const LoadingCurve &curve,
                const unsigned int  stage_index,
                const double error = std::numeric_limits<double>::quiet_NaN());
} // namespace fiberloom

#endif
