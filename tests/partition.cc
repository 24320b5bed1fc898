// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// Whatever the number of ranks, the system of equations is the one that a
// single rank has: energy, residual, reactions, products with the matrix and
// the solution.

#include <fiberloom/solvers/linear_solver.h>

#include <deal.II/base/mpi.h>

#include <fstream>

#include "checks.h"
#include "sample_model.h"

using namespace fiberloom;

namespace
{
  /** What the ranks of @p comm find together, on each of them. */
  struct Result
  {
    double                  energy, residual_norm, force_scale;
    std::vector<BodyVector> reactions;
    Eigen::VectorXd         right_hand_side, product, solution;
    unsigned int            owned;
  };

  Result
  evaluate(const MPI_Comm comm)
  {
    SampleModel model(6);
    model.supports.bodies[1].prescribed.set();
    System system(model.mesh, model.supports, comm);

    model.disturb(system);
    model.targets.bodies[1].placement.position = Vector3(6.1, -2, 1);
    model.add_contacts(.02, .001);
    system.reinit(model.contacts);
    system.assemble(model.state, model.targets, model.contacts);

    Result result{system.energy(model.state, model.contacts),
                  system.residual_norm(),
                  system.force_scale(),
                  system.reactions(),
                  system.gather(system.right_hand_side()),
                  multiply(system,
                           Eigen::ArrayXd::LinSpaced(system.layout().n_dofs(),
                                                     1,
                                                     system.layout().n_dofs())
                             .sin()
                             .matrix()),
                  {},
                  static_cast<unsigned int>(system.layout().n_owned_dofs())};

    std::vector<double> solution;
    LinearSolver(system, Preconditioning::double_factor)
      .solve({system.matrix(), system.right_hand_side()},
             model.state.q,
             {0, 1e-3 * system.stiffness_scale()},
             solution);
    result.solution = system.gather(solution);
    return result;
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const MPI_Comm                           world = MPI_COMM_WORLD;
  const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(world);
  const Result       alone   = evaluate(MPI_COMM_SELF);
  const Result       shared  = evaluate(world);

  double reactions = 0;
  for (unsigned int b = 0; b < alone.reactions.size(); ++b)
    reactions =
      std::max(reactions,
               relative_error(shared.reactions[b], alone.reactions[b]));
  const std::array<double, 6> mine{
    {std::abs(shared.energy / alone.energy - 1),
     std::abs(shared.residual_norm / alone.residual_norm - 1),
     std::abs(shared.force_scale / alone.force_scale - 1),
     reactions,
     relative_error(shared.right_hand_side, alone.right_hand_side),
     relative_error(shared.product, alone.product)}};
  std::array<double, 6> errors;
  for (unsigned int i = 0; i < errors.size(); ++i)
    errors[i] = dealii::Utilities::MPI::max(mine[i], world);
  const double solution =
    dealii::Utilities::MPI::max(relative_error(shared.solution, alone.solution),
                                world);
  const double most = dealii::Utilities::MPI::max(double(shared.owned), world);

  if (dealii::Utilities::MPI::this_mpi_process(world) != 0)
    return 0;
  std::ofstream output("output");
  Checks        checks(output);
  checks.below("largest share of the dofs over the mean",
               most * n_ranks / alone.owned,
               1.3);
  checks.below("energy", errors[0], 1e-12);
  checks.below("residual norm", errors[1], 1e-10);
  checks.below("force scale", errors[2], 1e-12);
  checks.below("reactions", errors[3], 1e-10);
  checks.below("right hand side", errors[4], 1e-12);
  checks.below("product", errors[5], 1e-12);
  checks.below("solution", solution, 1e-7);
}
