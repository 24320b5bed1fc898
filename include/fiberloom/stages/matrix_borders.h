// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_stages_matrix_borders_h
#define fiberloom_stages_matrix_borders_h

#include <fiberloom/stages/stage.h>

#include <bitset>

namespace fiberloom
{
  /**
   * Rigid bodies on the four upright borders of the matrix: x start, x end, y
   * start, y end, in this order behind the bodies of a fabric's tow ends.
   */
  namespace MatrixBorders
  {
    constexpr unsigned int n_bodies = 4;

    /** What the bodies hold of their nodes. */
    enum class Grip
    {
      none,
      across, // the displacement across the border
      whole
    };

    /** The attachment of a node of the matrix, its displacements along the axes
     * of the sample held where @p held says so. */
    Attachment
    attach(const Composite     &composite,
           const unsigned int   matrix_node,
           const unsigned int   body,
           const std::bitset<3> held);

    /**
     * Adds the bodies, all dofs prescribed, to @p supports , and lets them hold
     * their nodes. Edges between two borders go with those of x. None where
     * the scene has no matrix.
     */
    void
    add(const Scene &scene, const Grip grip, Supports &supports);

    /** Places them in the middle of their nodes, from body number @p first on.
     */
    void
    place(const Scene &scene, const unsigned int first, State &state);
  } // namespace MatrixBorders
} // namespace fiberloom

#endif
