// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_paths_h
#define fiberloom_output_paths_h

#include <fiberloom/fabric/fiber_set.h>

#include <fiberloom/beams/fiber_mesh.h>

#include <string>

namespace fiberloom
{
  /**
   * The axes of the fibers at @p q as a table, the nodes one after the other,
   * with what read_fiber_file() knows of a fiber: its tow, the tow's family, if
   * it has one, radius and moduli.
   */
  std::string
  paths_csv(const FiberSet &fibers, const FiberMesh &mesh, const DofVector &q);
} // namespace fiberloom

#endif
