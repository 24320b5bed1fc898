// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_stages_tow_ends_h
#define fiberloom_stages_tow_ends_h

#include <fiberloom/stages/matrix_borders.h>

namespace fiberloom
{
  /**
   * The rigid bodies of a fabric: one on each end of each tow, in the order of
   * the tows, start before end, then the ground, then those on the borders of
   * a matrix if there is one. A tow end holds the
   * centres of its fibers and the direction of their first section vector, so
   * that they cannot spin but may slope up and down. A periodic cell has no
   * ends: what is asked of them is asked of its periods, see Cell.
   */
  namespace TowEnds
  {
    /** Number of the body of the start (side 0) or end (side 1) of @p tow . */
    inline unsigned int
    body(const unsigned int tow, const unsigned int side)
    {
      return 2 * tow + side;
    }

    /** Unit vector along a tow before weaving. */
    Vector3
    axis(const Tow &tow);

    /**
     * All dofs prescribed, but the translations along the warp tows, along the
     * fill tows or both, where @p free has these, and the slopes of tows with
     * layers there; then the middle of every fiber of such a tow is held along
     * its axis by the ground. The matrix is free where both are, else its
     * borders are held as @p grip says, but across a free direction.
     */
    Supports
    supports(const Scene              &scene,
             const std::bitset<2>      free,
             const MatrixBorders::Grip grip = MatrixBorders::Grip::across);

    /**
     * Places bodies at the mean of the centres that they hold, where @p state
     * has no placements.
     */
    void
    place(const Scene &scene, const MatrixBorders::Grip grip, State &state);

    /** Mean axial pull on the two ends of all tows of a family and, where it is
     * held, of the matrix across the same borders [N]. */
    double
    pull(const Scene                   &scene,
         const Tow::Family              family,
         const std::vector<BodyVector> &reactions);
  } // namespace TowEnds
} // namespace fiberloom

#endif
