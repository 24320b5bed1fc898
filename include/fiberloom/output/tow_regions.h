// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_tow_regions_h
#define fiberloom_output_tow_regions_h

#include <fiberloom/output/tow_shape.h>

#include <vector>

namespace fiberloom
{
  /**
   * Bodies of tows without overlap. Where the hulls of two tows overlap, each
   * gets what is nearer to its fibers, less half of a gap.
   */
  class TowRegions
  {
  public:
    /**
     * @p gap is that between tows, along the lines of the lattice; @p margin
     * around the bodies, more than the gap, is where levels are known [mm].
     */
    TowRegions(const std::vector<TowShape> &shapes,
               const Lattice               &lattice,
               const double                 gap,
               const double                 margin);

    /**
     * Negative inside the region of @p tow , of which @p value is at point @p i
     * [mm]. At a point the levels of any two tows add up to the gap or more, if
     * that of a tow beyond the margin is the margin: so linear interpolation
     * never finds a place in both.
     */
    double
    level(const int              tow,
          const Lattice::Index  &i,
          const TowShape::Value &value) const;

    const Lattice &
    points() const
    {
      return lattice;
    }

    double
    known_up_to() const
    {
      return margin;
    }

  private:
    struct Candidate
    {
      int   tow = -1;
      float outside, to_fiber; // TowShape::Value
    };

    void
    add(const int tow, const Lattice::Index &i, const TowShape::Value &value);

    const Lattice lattice;
    const double  gap, margin;

    // The tows next to each point, the nearest first; -1 where there are less.
    std::vector<std::array<Candidate, 4>> candidates;
  };
} // namespace fiberloom

#endif
