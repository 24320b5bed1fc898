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
  /** Of which increment rows of tables about @p report are. */
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

    /** The values of @p column over the rows of a stage, NaN where empty. */
    std::vector<double>
    values(const unsigned int stage_index, const unsigned int column) const;

    /** Loads of the rows of a stage. */
    std::vector<double>
    loads(const unsigned int stage_index) const;
  };

  /** A column's name in words: "force_warp[N]" as "force warp [N]". */
  std::string
  readable(std::string column);

  /**
   * The loading curve of a stage as SVG: the bending moment [N.mm], or else all
   * forces [N], or where there are none all moments [N.mm], or the pressure
   * [MPa], over the strain, angle or fiber volume fraction that varies most,
   * else over the load. Empty when there are not two points to draw. A
   * finite @p error is drawn as a band around the curves, over the largest of
   * their values.
   */
  std::string
  curve_picture(const LoadingCurve &curve,
                const unsigned int  stage_index,
                const double error = std::numeric_limits<double>::quiet_NaN());
} // namespace fiberloom

#endif
