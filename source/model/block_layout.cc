// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/model/block_layout.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/point.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <numeric>

namespace fiberloom
{
  namespace
  {
    std::vector<unsigned int>
    nodes_along_curve(const FiberMesh       &mesh,
                      const Eigen::VectorXd &matrix_nodes)
    {
      std::vector<dealii::Point<3>> points;
      points.reserve(mesh.n_nodes() + matrix_nodes.size() / 3);
      for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
        points.emplace_back(mesh.initial()[9 * n],
                            mesh.initial()[9 * n + 1],
                            mesh.initial()[9 * n + 2]);
      for (Eigen::Index i = 0; i < matrix_nodes.size(); i += 3)
        points.emplace_back(matrix_nodes[i],
                            matrix_nodes[i + 1],
                            matrix_nodes[i + 2]);
      const auto keys =
        dealii::Utilities::inverse_Hilbert_space_filling_curve(points, 20);

      std::vector<unsigned int> order(points.size());
      std::iota(order.begin(), order.end(), 0);
      std::stable_sort(order.begin(),
                       order.end(),
                       [&](const auto a, const auto b) {
                         return keys[a] < keys[b];
                       });
      return order;
    }
  } // namespace



  BlockLayout::BlockLayout(const FiberMesh       &mesh,
                           const Eigen::VectorXd &matrix_nodes,
                           const unsigned int     n_bodies,
                           const MPI_Comm         communicator)
    : comm(communicator)
    , n_all_nodes(mesh.n_nodes() + matrix_nodes.size() / 3)
    , owners(n_all_nodes + n_bodies)
  {
    const unsigned int n_ranks =
      dealii::Utilities::MPI::n_mpi_processes(communicator);
    if (n_ranks > 1)
      {
        const auto order = nodes_along_curve(mesh, matrix_nodes);
        for (std::size_t i = 0; i < order.size(); ++i)
          owners[order[i]] = i * n_ranks / order.size();
      }
    for (unsigned int b = 0; b < n_bodies; ++b)
      owners[n_all_nodes + b] = b % n_ranks;

    std::vector<unsigned int> sizes(owners.size(), 6);
    std::fill_n(sizes.begin(), n_all_nodes, 3);
    std::fill_n(sizes.begin(), mesh.n_nodes(), 9);
    number(sizes);
  }



  BlockLayout::BlockLayout(const BlockLayout               &other,
                           const std::vector<unsigned int> &sizes)
    : comm(other.comm)
    , n_all_nodes(other.n_all_nodes)
    , owners(other.owners)
  {
    number(sizes);
  }



  void
  BlockLayout::number(const std::vector<unsigned int> &sizes)
  {
    const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(comm);
    first_dofs.assign(1, 0);
    for (const unsigned int size : sizes)
      first_dofs.push_back(first_dofs.back() + size);

    local_blocks.assign(owners.size(), -1);
    for (unsigned int block = 0; block < owners.size(); ++block)
      if (owners[block] == rank)
        {
          local_blocks[block] = owned.size();
          owned.push_back(block);
          local_first_dofs.push_back(n_own_dofs);
          n_own_dofs += size(block);
        }
  }



  dealii::IndexSet
  BlockLayout::owned_dofs() const
  {
    dealii::IndexSet dofs(n_dofs());
    for (const unsigned int block : owned)
      dofs.add_range(first_dof(block), first_dofs[block + 1]);
    dofs.compress();
    return dofs;
  }
} // namespace fiberloom
