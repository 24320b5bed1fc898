// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_tow_sections_h
#define fiberloom_output_tow_sections_h

#include <fiberloom/fabric/fiber_set.h>

#include <fiberloom/beams/fiber_mesh.h>

#include <vector>

namespace fiberloom
{
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

  /** Width over height of the sections of tows: smallest, mean and largest. */
  struct TowAspect
  {
    double smallest = 0;
    double mean     = 0;
    double largest  = 0;
  };

  TowAspect
  tow_aspect(const std::vector<TowSection> &sections);
} // namespace fiberloom

#endif
