// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_tow_sections_h
#define fiberloom_output_tow_sections_h

#include <fiberloom/fabric/fiber_set.h>

#include <fiberloom/beams/fiber_mesh.h>

#include <array>
#include <vector>

namespace fiberloom
{
  /** A plane across the mean line of a tow's fibers, and what it cuts. */
  struct TowCut
  {
    using Point = std::array<double, 2>; // along across and up [mm]

    Vector3              center;     // of the mean line [mm]
    Vector3              tangent;    // unit, mean of the fibers
    Vector3              across, up; // unit, across is horizontal
    std::vector<Section> fibers;     // where each passes the plane
    std::vector<double>  areas;      // of their cuts [mm^2]

    /**
     * Coordinates of @p position in the plane of the cut, from the center [mm].
     */
    Point
    point(const Vector3 &position) const;

    /**
     * Convex hull of the fibers' skins, in counter-clockwise order; each skin
     * has @p n_around points.
     */
    std::vector<Point>
    hull(const unsigned int n_around) const;
  };

  /**
   * Cuts a tow at a fraction of the length of its fibers, from 0 to 1. A fiber
   * that does not reach the plane is cut at its end.
   */
  TowCut
  cut_tow(const Tow       &tow,
          const FiberMesh &mesh,
          const DofVector &q,
          const double     fraction);

  /** Area inside a polygon [mm^2], positive in counter-clockwise order. */
  double
  polygon_area(const std::vector<TowCut::Point> &polygon);

  /** The section of a tow by a plane across the mean line of its fibers. */
  struct TowSection
  {
    double  abscissa; // length of the mean line up to here [mm]
    Vector3 centroid; // of the fibers' sections [mm]
    double  width;    // horizontal extent, across the tow [mm]
    double  height;   // extent across that [mm]
    double  area;     // of the convex hull of the fibers' sections [mm^2]
    double  packing;  // share of it that is fiber
  };

  /** One section for each node along the fibers of tow @p tow . */
  std::vector<TowSection>
  tow_sections(const FiberSet    &fibers,
               const FiberMesh   &mesh,
               const DofVector   &q,
               const unsigned int tow);
} // namespace fiberloom

#endif
