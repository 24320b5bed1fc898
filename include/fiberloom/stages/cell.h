// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_stages_cell_h
#define fiberloom_stages_cell_h

#include <fiberloom/stages/stage.h>

#include <bitset>
#include <limits>

namespace fiberloom
{
  /**
   * The supports of a periodic cell. Its mean deformation is the first body,
   * see PeriodicCell. What costs no energy is taken away from each fiber by one
   * of its nodes, at the first tow that crosses it: to slide along itself and
   * to spin.
   */
  namespace Cell
  {
    constexpr unsigned int body = 0;

    /** Whether the middle fiber of each tow keeps its place across the tow,
     * where no friction does so. */
    enum class Spacing
    {
      free,
      held
    };

    /**
     * Supports of the cell of @p scene . @p free : for the elongations along
     * warp and fill and for the shear, whether the mean stress is given in
     * place of the motion. @p plies_held : of how many plies, from the lowest
     * on, one node keeps its height. Section 3.2 of the theory.
     */
    Supports
    supports(
      const Scene         &scene,
      const std::bitset<3> free,
      const Spacing        spacing  = Spacing::free,
      const unsigned int plies_held = std::numeric_limits<unsigned int>::max());

    /** Gives @p state an undeformed cell where it has none yet. */
    void
    place(State &state);

    /**
     * Lengths of the periods along warp and fill [mm] where the cell is placed
     * at @p placement .
     */
    std::array<double, 2>
    periods(const Scene &scene, const Placement &placement);

    /**
     * The placement of the cell after its elongations along warp and fill have
     * grown from those at @p start by @p warp_strain and @p fill_strain times
     * the periods at @p start . The shear stays.
     */
    Placement
    strained(const Scene     &scene,
             const Placement &start,
             const double     warp_strain,
             const double     fill_strain);

    /**
     * The placement of the cell after the right angle between its periods has
     * closed by @p angle more than at @p start [rad], while the periods keep
     * the lengths that they have there.
     */
    Placement
    sheared(const Scene &scene, const Placement &start, const double angle);

    /**
     * Derivative of the three elongations by the angle of sheared(), at
     * @p placement [mm/rad].
     */
    Vector3
    shear_rate(const Scene &scene, const Placement &placement);

    /**
     * Mean deformation gradient, a 3 x 3 matrix, where the cell is placed at
     * @p placement .
     */
    Matrix3
    gradient(const Scene &scene, const Placement &placement);

    /**
     * Both periods in the plane as columns of a 2 x 2 matrix [mm], where the
     * cell is placed at @p placement .
     */
    Eigen::Matrix2d
    plane_periods(const Scene &scene, const Placement &placement);

    /**
     * Area of the cell in the plane [mm^2] where it is placed at @p placement .
     */
    double
    area(const Scene &scene, const Placement &placement);

    /**
     * Force with which the cell is pulled along @p family [N]: the mean stress
     * times the cell's width, from the @p reactions of the bodies.
     */
    double
    pull(const Tow::Family family, const std::vector<BodyVector> &reactions);

    /** Columns that all curves of a cell have: forces per width, periods and
     * shear strain. */
    CurveRow
    curve(const Scene                   &scene,
          const State                   &state,
          const std::vector<BodyVector> &reactions);
  } // namespace Cell
} // namespace fiberloom

#endif
