// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_fabric_vtk_fibers_h
#define fiberloom_fabric_vtk_fibers_h

#include <fiberloom/fabric/fiber_file.h>

namespace fiberloom
{
  /**
   * The lines of a file .vtp or .vtu, each cell a fiber. Values come from
   * arrays of cells or of points, which then must not change along a fiber; a
   * unit may follow their names. All counts, types and ranges are checked
   * before they are used. Throws InputError.
   */
  FiberFile
  read_vtk_fibers(const std::string &file);
} // namespace fiberloom

#endif
