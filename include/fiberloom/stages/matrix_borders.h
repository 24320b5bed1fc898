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
   * start, y end, in this order behind the bodies of a fabric's tow ends. With
   * Grip::across four more follow, on the upright edges x start and y start, x
   * start and y end, x end and y start, x end and y end, which hold both
   * displacements.
   */
  namespace MatrixBorders
  {
    constexpr unsigned int n_bodies = 4, n_edges = 4;

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
     * Adds the bodies to @p supports , and lets them hold their nodes. All dofs
     * are prescribed but that of a border across x or y where this is @p free .
     * Edges that are held whole go with the borders of x. None where the scene
     * has no matrix.
     */
    void
    add(const Scene         &scene,
        const Grip           grip,
        const std::bitset<2> free,
        Supports            &supports);

    /** Places them in the middle of their nodes, from body number @p first on;
     * bodies of edges where they go with both borders. */
    void
    place(const Scene       &scene,
          const unsigned int first,
          const Grip         grip,
          State             &state);

    /**
     * Mean pull along @p axis , 0 or 1, on the two borders across it [N], whose
     * bodies begin with number @p first .
     */
    double
    pull(const unsigned int             first,
         const unsigned int             axis,
         const std::vector<BodyVector> &reactions);
  } // namespace MatrixBorders
} // namespace fiberloom

#endif
