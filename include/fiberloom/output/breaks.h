// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_breaks_h
#define fiberloom_output_breaks_h

#include <fiberloom/beams/fiber_mesh.h>

#include <string>

namespace fiberloom
{
  /**
   * Text of breaks.csv: a row for each broken element in the order of the
   * breaks. Elements are counted within the fiber, from 0; the stress is
   * Young's modulus times the strain that broke it.
   */
  std::string
  breaks_csv(const FiberMesh &mesh, const FiberHistory &history);
} // namespace fiberloom

#endif
