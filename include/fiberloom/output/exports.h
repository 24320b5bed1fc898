// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_exports_h
#define fiberloom_output_exports_h

#include <fiberloom/base/parameters.h>

#include <fiberloom/fabric/fiber_set.h>

#include <fiberloom/beams/fiber_mesh.h>

namespace fiberloom
{
  /**
   * Writes what Output/Export names to the directory export in the output
   * directory, from the fibers at @p q . To be called on one rank. Throws
   * StageFailure when a file cannot be written.
   */
  void
  write_exports(const Parameters &parameters,
                const FiberSet   &fibers,
                const FiberMesh  &mesh,
                const DofVector  &q);
} // namespace fiberloom

#endif
