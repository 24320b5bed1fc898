// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_simulation_membrane_stiffness_h
#define fiberloom_simulation_membrane_stiffness_h

#include <fiberloom/solvers/linear_solver.h>

#include <fiberloom/stages/stage.h>

namespace fiberloom
{
  /** A state in balance, and what holds it so. */
  struct Balance
  {
    const Supports                    &supports;
    const State                       &state;
    const std::vector<ContactElement> &contacts;
    const std::vector<BodyVector>     &reactions; // per body [N], [N mm]
  };

  /**
   * Derivative of the forces per width along warp, along fill and in shear by
   * the strains [N/mm], a symmetric 3 x 3 matrix row by row, of a periodic cell
   * in @p balance . Strains count from its state on. The cell is let free under
   * what holds it; each of three unit loads then has an answer by the exact
   * tangent, and the inverse of these is the stiffness condensed onto the cell.
   * Collective. Adds to @p statistics . Throws StageFailure where the tangent
   * is singular. Section 5.7 of the theory.
   */
  std::vector<double>
  membrane_stiffness(const Scene     &scene,
                     const Balance   &balance,
                     const MPI_Comm   comm,
                     StageStatistics &statistics);

  /** Mean distance of the flat faces of a cell that is filled with matrix [mm],
   * 0 of others. */
  double
  filled_thickness(const Scene &scene, const State &state);
} // namespace fiberloom

#endif
