// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/model/assembly.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <utility>

namespace fiberloom
{
  Assembly::Assembly(const Motion      &motion,
                     const Supports    &supports,
                     const BlockLayout &layout,
                     BlockMatrix       &matrix)
    : motion(motion)
    , layout(layout)
    , supports(supports)
    , tangent(&matrix)
    , sum(layout.n_owned_dofs())
  {}



  void
  Assembly::restrict_to(std::vector<char> blocks, BlockMatrix &matrix)
  {
    taken   = std::move(blocks);
    tangent = &matrix;
  }



  void
  Assembly::begin(const State &state, const Curvature curvature)
  {
    this->state  = &state;
    adds_tangent = curvature != Curvature::none;
    largest      = 0;
    std::fill(sum.begin(), sum.end(), 0.);
    if (adds_tangent)
      {
        curvature_of_energy = curvature;
        tangent->set_zero();
        tangent->remove_outer_products();
      }
  }



  void
  Assembly::reduce_largest_force()
  {
    largest = dealii::Utilities::MPI::max(largest, layout.communicator());
  }



  bool
  Assembly::touches_owned(const unsigned int           *nodes,
                          const unsigned int            n,
                          const std::vector<NodeImage> &images) const
  {
    const auto owns_body = [this](const unsigned int body) {
      return layout.local_block(layout.body_block(body)) >= 0;
    };
    if (is_restricted() &&
        std::none_of(nodes, nodes + n, [&](const unsigned int node) {
          return takes(original(node, images));
        }))
      return false;
    for (unsigned int a = 0; a < n; ++a)
      {
        unsigned int node = nodes[a];
        if (node < images.size())
          {
            if (images[node].periods != std::array<int, 2>() &&
                owns_body(supports.cell->body))
              return true;
            node = images[node].node;
          }
        if (layout.local_block(node) >= 0)
          return true;
        const int i = motion.attachment(node);
        if (i >= 0 && owns_body(supports.attachments[i].body))
          return true;
      }
    return false;
  }



  HeldGroup
  Assembly::held_group(const std::vector<unsigned int> &nodes,
                       const std::vector<NodeImage>    &images) const
  {
    return HeldGroup({nodes.data(), nodes.size()},
                     motion.attachments(),
                     supports,
                     layout,
                     images);
  }



  void
  Assembly::add_product(HeldGroup &rows, HeldGroup &columns)
  {
    rows.transform(state->q, state->placements, HeldGroup::Parts::forces);
    columns.transform(state->q, state->placements, HeldGroup::Parts::forces);
    std::vector<unsigned int> blocks;
    std::vector<double>       row, column;
    for (unsigned int a = 0; a < rows.n_blocks(); ++a)
      {
        const unsigned int block = rows.block(a);
        blocks.push_back(block);
        const Eigen::VectorXd r = rows.force(a), c = columns.force(a);
        for (unsigned int i = 0; i < r.size(); ++i)
          {
            const bool fixed = motion.is_fixed(layout.first_dof(block) + i);
            row.push_back(fixed ? 0 : r[i]);
            column.push_back(fixed ? 0 : c[i]);
          }
      }
    tangent->add_outer_product(
      blocks,
      Eigen::Map<const Eigen::VectorXd>(row.data(), row.size()),
      Eigen::Map<const Eigen::VectorXd>(column.data(), column.size()));
  }
} // namespace fiberloom
