// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/solvers/moving_fibers.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace fiberloom
{
  MovingFibers::MovingFibers(const FiberMesh &mesh, System &system)
    : mesh(mesh)
    , system(system)
  {}



  void
  MovingFibers::release()
  {
    moving.clear();
    system.restrict_to(moving);
  }



  void
  MovingFibers::choose(const std::vector<double> &moves, const double part)
  {
    release();
    const double furthest = *std::max_element(moves.begin(), moves.end());
    const auto   goes_on  = [&](const double move) {
      return move > part * furthest;
    };
    if (std::count_if(moves.begin(), moves.end(), goes_on) >
        part * moves.size())
      return;
    moving.assign(system.layout().n_blocks(), false);
    for (unsigned int fiber = 0; fiber < moves.size(); ++fiber)
      if (goes_on(moves[fiber]))
        std::fill_n(moving.begin() + mesh.lines()[fiber].first_node,
                    mesh.lines()[fiber].n_nodes(),
                    true);
    iterations = 0;
    system.restrict_to(moving);
  }



  void MovingFibers::restrict(std::vector<double> &values) const
  {
    if (are_all())
      return;
    const BlockLayout &layout = system.layout();
    for (unsigned int b = 0; b < layout.owned_blocks().size(); ++b)
      if (const unsigned int block = layout.owned_blocks()[b]; !moving[block])
        std::fill_n(values.begin() + layout.local_first_dof(b),
                    layout.size(block),
                    0.);
  }



  void
  MovingFibers::restrict_matrix() const
  {
    if (!are_all())
      system.matrix().isolate(moving, system.stiffness_scale());
  }



  bool
  MovingFibers::are_worth_it(const double part, const unsigned int most)
  {
    const std::vector<double> all   = system.free_residual();
    std::vector<double>       their = all;
    restrict(their);
    double inside = 0, outside = 0;
    for (unsigned int i = 0; i < all.size(); ++i)
      {
        inside  = std::max(inside, std::abs(their[i]));
        outside = std::max(outside, std::abs(all[i] - their[i]));
      }
    const MPI_Comm comm = system.layout().communicator();
    inside              = dealii::Utilities::MPI::max(inside, comm);
    outside             = dealii::Utilities::MPI::max(outside, comm);
    if (iterations == 0)
      first = inside;
    if (iterations++ == most || inside < std::max(outside, part * first))
      return false;
    system.restrict_to(moving);
    return true;
  }
} // namespace fiberloom
