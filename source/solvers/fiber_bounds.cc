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
    , fiber_of_node(mesh.n_nodes())
    , multipliers(mesh.lines().size())
  {
    for (unsigned int fiber = 0; fiber < multipliers.size(); ++fiber)
      {
        const auto &line = mesh.lines()[fiber];
        std::fill_n(fiber_of_node.begin() + line.first_node,
                    line.n_nodes(),
                    fiber);
      }
  }



  bool
  FiberBounds::hold_some() const
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
    std::vector<double> of_nodes(fiber_of_node.size());
    for (unsigned int node = 0; node < of_nodes.size(); ++node)
      of_nodes[node] = multipliers[fiber_of_node[node]];
    system.matrix().add_to_diagonal(of_nodes);
  }



  template <typename Function>
  void
  FiberBounds::for_each_dof(const Function &function) const
  {
    const BlockLayout &layout = system.layout();
    for (const unsigned int block : layout.owned_blocks())
      if (block < fiber_of_node.size())
        {
          const unsigned int first =
            layout.local_first_dof(layout.local_block(block));
          for (unsigned int i = first; i < first + layout.size(block); ++i)
            function(i, fiber_of_node[block]);
        }
  }



  std::vector<double>
  FiberBounds::moves(const Eigen::VectorXd &increment) const
  {
    std::vector<double> moves(multipliers.size());
    for (unsigned int node = 0; node < fiber_of_node.size(); ++node)
      {
        const unsigned int fiber = fiber_of_node[node];
        const double       bound = largest_move * mesh.lines()[fiber].radius;
        for (unsigned int v = 0; v < 3; ++v)
          moves[fiber] =
            std::max(moves[fiber],
                     increment.segment<3>(9 * node + 3 * v).norm() / bound);
      }
    return moves;
  }



  void
  FiberBounds::update(const std::vector<double> &gradient,
                      const std::vector<double> &step,
                      const Eigen::VectorXd     &increment,
                      const bool                 at_once)
  {
    std::vector<double> work(multipliers.size()), square(multipliers.size());
    for_each_dof([&](const unsigned int i, const unsigned int fiber) {
      work[fiber] += gradient[i] * step[i];
      square[fiber] += step[i] * step[i];
    });
    const MPI_Comm comm = system.layout().communicator();
    dealii::Utilities::MPI::sum(work, comm, work);
    dealii::Utilities::MPI::sum(square, comm, square);

    const std::vector<double> moves = this->moves(increment);
    std::vector<double>       change(multipliers.size());
    for (unsigned int fiber = 0; fiber < multipliers.size(); ++fiber)
      {
        double &multiplier = multipliers[fiber];
        if (moves[fiber] <= 1 && (at_once || multiplier == 0))
          continue;
        // As if it moved along the step by itself, like a spring.
        const double stiffness =
          moves[fiber] > 1 ? std::max(multiplier, work[fiber] / square[fiber]) :
                             multiplier;
        double wanted = multiplier + (moves[fiber] - 1) * stiffness;
        if (wanted < least_multiplier * system.stiffness_scale())
          wanted = 0;
        change[fiber] = wanted - multiplier;
        multiplier    = wanted;
      }
    if (at_once)
      add_to_matrix(change);
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
