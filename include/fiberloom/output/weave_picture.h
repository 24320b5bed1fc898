// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_weave_picture_h
#define fiberloom_output_weave_picture_h

#include <fiberloom/fabric/fiber_set.h>

#include <fiberloom/beams/fiber_mesh.h>

#include <fiberloom/model/composite.h>

#include <string>

namespace fiberloom
{
  /** The eight around a periodic cell in its picture. */
  enum class Neighbors
  {
    hidden,
    shown
  };

  /**
   * The whole sample seen from above at an angle, every fiber with its
   * deformed sections in the colour of its tow; content of a PNG file. Needs
   * no display. Of a matrix, unless @p composite is null, all cells are seen
   * but those above the middle plane in the front half. Neighbors have
   * lighter colours.
   */
  std::string
  weave_picture(const FiberSet  &fibers,
                const FiberMesh &mesh,
                const DofVector &q,
                const Composite *composite = nullptr,
                const Neighbors  neighbors = Neighbors::hidden);
} // namespace fiberloom

#endif
