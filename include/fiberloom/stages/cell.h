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

    /** @p free : elongations along warp and fill and the shear whose mean
     * stress is given. @p plies_held : of how many plies, from the lowest on,
     * one node keeps its height. */
    Supports
    supports(
      const Scene         &scene,
      const std::bitset<3> free,
      const Spacing        spacing  = Spacing::free,
      const unsigned int plies_held = std::numeric_limits<unsigned int>::max());

    /** Undeformed where @p state has no cell yet. */
    void
    place(State &state);

    /** Periods along warp and fill [mm] of a cell that is placed so. */
    std::array<double, 2>
    periods(const Scene &scene, const Placement &placement);

    /** That of a cell which is strained by so much from @p start on. */
    Placement
    strained(const Scene     &scene,
             const Placement &start,
             const double     warp_strain,
             const double     fill_strain);

    /** That of a cell whose periods keep the lengths that they have at @p start
     * , while the right angle between them closes by @p angle more [rad]. */
    Placement
    sheared(const Scene &scene, const Placement &start, const double angle);

    /** By how much the elongations grow with the angle at a placement
     * [mm/rad]. */
    Vector3
    shear_rate(const Scene &scene, const Placement &placement);

    /** Mean deformation gradient of a cell that is placed so. */
    Matrix3
    gradient(const Scene &scene, const Placement &placement);

    /** Its periods in the plane, one a column [mm]. */
    Eigen::Matrix2d
    plane_periods(const Scene &scene, const Placement &placement);

    /** Of a cell that is placed so, in the plane [mm^2]. */
    double
    area(const Scene &scene, const Placement &placement);

    /** Mean stress times the cell's width where the stage began [N]. */
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
