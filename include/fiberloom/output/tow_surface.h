// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_tow_surface_h
#define fiberloom_output_tow_surface_h

#include <fiberloom/output/tow_regions.h>

#include <array>
#include <string>
#include <vector>

namespace fiberloom
{
  /** The closed surface of a tow, its ends included. */
  struct TowSurface
  {
    std::vector<Vector3>                     points;    // [mm]
    std::vector<std::array<unsigned int, 3>> triangles; // seen from outside
                                                        // counter-clockwise
  };

  /**
   * The surface around the region in which @p levels are negative, given at the
   * points of @p lattice ; at its border they have to be positive.
   */
  TowSurface
  level_surface(const Lattice &lattice, const std::vector<float> &levels);

  /**
   * The surface of each tow, found in a lattice of @p spacing . No two of them
   * touch.
   */
  std::vector<TowSurface>
  tow_surfaces(const std::vector<TowShape> &shapes, const double spacing);

  /** All @p surfaces as one .vtp, each triangle with its tow. */
  std::string
  surfaces_vtp(const std::vector<TowSurface> &surfaces);

  /** Writes all as one binary .stl. Throws StageFailure. */
  void
  write_surfaces_stl(const std::string             &file,
                     const std::vector<TowSurface> &surfaces);
} // namespace fiberloom

#endif
