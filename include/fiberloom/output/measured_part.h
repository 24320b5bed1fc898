// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_measured_part_h
#define fiberloom_output_measured_part_h

#include <fiberloom/fabric/fiber_set.h>

#include <fiberloom/beams/fiber_mesh.h>

#include <array>
#include <optional>
#include <vector>

namespace fiberloom
{
  /** The part of a flat fabric whose weight, thickness and crimp are measured,
   * as far as possible from the ends of tows. */
  struct MeasuredPart
  {
    /** The part of one tow. */
    struct TowPart
    {
      std::array<double, 2> fractions; // of the tow's length, from and to
      double                length;    // between, straight in the fabric's
                                       // plane [mm]
      double share; // of the tow that is inside: 1, or 1/2 on a border
    };

    double                             area;   // in the fabric's plane [mm^2]
    Vector3                            normal; // of that plane, unit
    std::vector<TowPart>               tows;   // as in FiberSet
    std::vector<std::array<double, 2>> fibers; // parameters u, from and to
  };

  /**
   * What lies between the first and the last crossing of each tow, the lines
   * of the outermost tows being the borders. None where a family has less than
   * two tows, tows do not cross in order, or the fabric is not flat. A periodic
   * cell is measured as a whole.
   */
  std::optional<MeasuredPart>
  part_between_crossings(const FiberSet  &fibers,
                         const FiberMesh &mesh,
                         const DofVector &q);
} // namespace fiberloom

#endif
