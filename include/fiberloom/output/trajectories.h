// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_trajectories_h
#define fiberloom_output_trajectories_h

#include <fiberloom/fabric/fiber_set.h>

#include <fiberloom/beams/fiber_mesh.h>

#include <string>

namespace fiberloom
{
  /**
   * Text of trajectories.csv. Rows of kind "fiber" are points of a fiber's
   * centre line, two an element, with its curvature; rows of kind "tow" are
   * sections of a tow (TowSection), whose x, y, z are the centroid. Cells that
   * do not belong to a kind are empty. Tows and fibers count as in FiberSet,
   * from 0; the abscissa is the deformed length from the start.
   */
  std::string
  trajectories_csv(const FiberSet  &fibers,
                   const FiberMesh &mesh,
                   const DofVector &q);
} // namespace fiberloom

#endif
