// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/solvers/fiber_bounds.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace fiberloom
{
  namespace
  {
    // A multiplier below this, over E r, holds nothing.
    constexpr double least_multiplier = 1e-5;
  } // namespace



  FiberBounds::FiberBounds(const FiberMesh &mesh,
                           System          &system,
                           const double     largest_move)
    : mesh(mesh)
    , system(system)
    , largest_move(largest_move)
    , multipliers(mesh.lines().size())
  {}



  bool
  FiberBounds::hold_any() const
  {
    return std::any_of(multipliers.begin(),
                       multipliers.end(),
                       [](const double multiplier) { return multiplier > 0; });
  }



  void
  FiberBounds::release()
  {
    std::fill(multipliers.begin(), multipliers.end(), 0);
  }



  void
  FiberBounds::add_to_matrix()
  {
    add_to_matrix(multipliers);
  }



  void
  FiberBounds::add_to_matrix(const std::vector<double> &multipliers)
  {
    std::vector<double> of_nodes(mesh.n_nodes());
    for (unsigned int fiber = 0; fiber < multipliers.size(); ++fiber)
      {
        const auto &line = mesh.lines()[fiber];
        std::fill_n(of_nodes.begin() + line.first_node,
                    line.n_nodes(),
                    multipliers[fiber]);
      }
    system.matrix().add_to_diagonal(of_nodes);
  }



  template <typename Function>
  void
  FiberBounds::for_each_dof(const Function &function) const
  {
    const BlockLayout &layout = system.layout();
    for (unsigned int fiber = 0; fiber < mesh.lines().size(); ++fiber)
      {
        const auto &line = mesh.lines()[fiber];
        for (unsigned int node = line.first_node;
             node < line.first_node + line.n_nodes();
             ++node)
          if (const int local = layout.local_block(node); local >= 0)
            {
              const unsigned int first = layout.local_first_dof(local);
              for (unsigned int i = first; i < first + layout.size(node); ++i)
                function(i, fiber);
            }
      }
  }



  std::vector<double>
  FiberBounds::moves(const Eigen::VectorXd &increment) const
  {
    std::vector<double> moves = system.motion().largest_moves(increment);
    for (double &move : moves)
      move /= largest_move;
    return moves;
  }



  std::vector<double>
  FiberBounds::stiffness(const std::vector<double> &gradient,
                         const std::vector<double> &step) const
  {
    std::vector<double> work(multipliers.size()), square(multipliers.size());
    for_each_dof([&](const unsigned int i, const unsigned int fiber) {
      work[fiber] += gradient[i] * step[i];
      square[fiber] += step[i] * step[i];
    });
    const MPI_Comm comm = system.layout().communicator();
    dealii::Utilities::MPI::sum(work, comm, work);
    dealii::Utilities::MPI::sum(square, comm, square);
    // Pushed along by others, one may be as soft as what holds it.
    std::vector<double> stiffness = multipliers;
    for (unsigned int fiber = 0; fiber < stiffness.size(); ++fiber)
      if (square[fiber] > 0)
        stiffness[fiber] =
          std::max(stiffness[fiber], work[fiber] / square[fiber]);
    return stiffness;
  }



  void
  FiberBounds::raise(const std::vector<double> &moves,
                     const std::vector<double> &stiffness)
  {
    // As if each moved along the step by itself, like a spring.
    for (unsigned int fiber = 0; fiber < multipliers.size(); ++fiber)
      if (moves[fiber] > 1)
        multipliers[fiber] += (moves[fiber] - 1) * stiffness[fiber];
  }



  void
  FiberBounds::drop_least()
  {
    for (double &multiplier : multipliers)
      if (multiplier < least_multiplier * system.stiffness_scale())
        multiplier = 0;
  }



  void
  FiberBounds::hold(const std::vector<double> &gradient,
                    const std::vector<double> &step,
                    const Eigen::VectorXd     &increment)
  {
    std::vector<double> change = multipliers;
    raise(moves(increment), stiffness(gradient, step));
    drop_least();
    for (unsigned int fiber = 0; fiber < change.size(); ++fiber)
      change[fiber] = multipliers[fiber] - change[fiber];
    add_to_matrix(change);
  }



  void
  FiberBounds::prepare_next(const std::vector<double> &gradient,
                            const std::vector<double> &step,
                            const Eigen::VectorXd     &increment)
  {
    const std::vector<double> moves = this->moves(increment);
    raise(moves, stiffness(gradient, step));
    for (unsigned int fiber = 0; fiber < multipliers.size(); ++fiber)
      multipliers[fiber] *= std::min(1., moves[fiber]);
    drop_least();
  }



  void
  FiberBounds::cut(std::vector<double>   &step,
                   const Eigen::VectorXd &increment) const
  {
    const std::vector<double> moves = this->moves(increment);
    for_each_dof([&](const unsigned int i, const unsigned int fiber) {
      step[i] /= std::max(1., moves[fiber]);
    });
  }
} // namespace fiberloom
