// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_fiber_lines_h
#define fiberloom_output_fiber_lines_h

#include <fiberloom/fabric/fiber_set.h>

#include <fiberloom/beams/fiber_mesh.h>

#include <string>

namespace fiberloom
{
  /**
   * All fibers as the lines of one .vtp, with the point data of fiber_field(),
   * radius among them, and cell data tow, fiber and family (0 warp, 1 fill, 2
   * none).
   */
  std::string
  fibers_vtp(const FiberSet &fibers, const FiberMesh &mesh, const DofVector &q);
} // namespace fiberloom

#endif
