// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_matrix_woven_surface_h
#define fiberloom_matrix_woven_surface_h

#include <fiberloom/beams/fiber_mesh.h>

#include <vector>

namespace fiberloom
{
  enum class Side
  {
    lower,
    upper
  };

  /** How the borders of the fabric are. */
  enum class Borders
  {
    open,
    periodic // those of a cell
  };

  /** Whether @p mesh is that of a cell with its images. */
  inline Borders
  borders_of(const FiberMesh &mesh)
  {
    return mesh.originals().empty() ? Borders::open : Borders::periodic;
  }

  /** The highest or lowest material point of a section's skin, as components
   * along r g1 and r g2 on the unit circle. */
  std::array<double, 2>
  outermost_particle(const Section &section, const Side side);

  /**
   * Height of the fabric's surface over each vertex of a grid, x first: that of
   * the outermost skin within half a cell around; between neighbors where no
   * fiber passes. The grid of a periodic cell goes from border to border.
   * Throws InputError where no fiber passes at all.
   */
  std::vector<double>
  surface_heights(const FiberMesh           &mesh,
                  const DofVector           &q,
                  const Side                 side,
                  const std::vector<double> &x,
                  const std::vector<double> &y);
} // namespace fiberloom

#endif
