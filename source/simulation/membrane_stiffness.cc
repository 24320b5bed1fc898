// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/parameter_catalogue.h>
#include <fiberloom/base/parameters.h>

#include <fiberloom/stages/cell.h>
#include <fiberloom/stages/coat_settings.h>

#include <fiberloom/simulation/membrane_stiffness.h>

#include <Eigen/LU>

#include <cmath>

namespace fiberloom
{
  namespace
  {
    // Of the linear systems.
    constexpr double tolerance = 1e-10;

    // Over E r, tried where the tangent is singular.
    constexpr double least_shift = 1e-9;

    /** Elongations of the cell by unit loads on them [mm/N]. */
    Matrix3
    compliance(System          &system,
               LinearSolver    &solver,
               const State     &state,
               StageStatistics &statistics)
    {
      const BlockLayout &layout = system.layout();
      const unsigned int block  = layout.body_block(Cell::body);
      const int          local  = layout.local_block(block);
      Matrix3            compliance;
      for (unsigned int k = 0; k < 3; ++k)
        {
          std::vector<double> load(system.right_hand_side().size(), 0.), answer;
          if (local >= 0)
            load[layout.local_first_dof(local) + k] = 1;
          const LinearSolver::Outcome outcome =
            solver.solve({system.matrix(), load, tolerance},
                         state.q,
                         {0,
                          least_shift * system.stiffness_scale(),
                          LinearSolver::Indefinite::accepted},
                         answer);
          add(statistics, outcome);
          if (!outcome.converged)
            throw StageFailure("stage stiffness: the linear solver does not "
                               "reach a residual of " +
                               exact_text(tolerance));
          compliance.col(k) =
            system.gather(answer).segment<3>(layout.first_dof(block));
        }
      return compliance;
    }
  } // namespace



  double
  filled_thickness(const Scene &scene, const State &state)
  {
    if (scene.composite == nullptr ||
        matrix_of(scene.parameters).layers != Layers::filled)
      return 0;
    const MatrixMesh &matrix    = scene.composite->matrix();
    const auto        positions = scene.composite->positions(state.q);
    const auto        height    = [&](const MatrixBorder border) {
      const std::vector<unsigned int> nodes = matrix.border_nodes(border);
      double                          sum   = 0;
      for (const unsigned int node : nodes)
        sum += positions[3 * node + 2];
      return sum / nodes.size();
    };
    return height(MatrixBorder::top) - height(MatrixBorder::bottom);
  }



  std::vector<double>
  membrane_stiffness(const Scene     &scene,
                     const Balance   &balance,
                     const MPI_Comm   comm,
                     StageStatistics &statistics)
  {
    const State &state = balance.state;
    Supports     free  = balance.supports;
    for (unsigned int k = 0; k < 3; ++k)
      free.bodies[Cell::body].prescribed.reset(k);
    Targets targets;
    for (const Placement &placement : state.placements)
      targets.bodies.push_back({placement});
    targets.bodies[Cell::body].load.head<3>() =
      balance.reactions[Cell::body].head<3>();

    System       system(scene.mesh, free, comm, scene.composite);
    LinearSolver solver(system, scene.parameters.solver.linear_solver);
    auto         found = balance.contacts;
    system.reinit(found);
    system.set_curvature(Curvature::exact);
    system.assemble(state, targets, found);
    const Matrix3 stiffness =
      compliance(system, solver, state, statistics).inverse(); // [N/mm]
    if (!stiffness.allFinite())
      throw StageFailure("stage stiffness: the tangent is singular");

    // Elongations by strains; the same gives forces times the other width.
    const auto  periods = Cell::periods(scene, state.placements[Cell::body]);
    const auto &size    = *scene.fibers.cell;
    // Each period turns by half of what shear moves, over its length.
    const double        ratio     = std::sqrt(size[0] / size[1]);
    const double        length[3] = {periods[0],
                                     periods[1],
                                     2 / (ratio / periods[0] +
                                   1 / (ratio * periods[1]))};
    std::vector<double> result;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        result.push_back(length[i] * stiffness(i, j) * length[j] /
                         Cell::area(scene, state.placements[Cell::body]));
    return result;
  }
} // namespace fiberloom
