// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_model_scatter_h
#define fiberloom_model_scatter_h

#include <fiberloom/model/held_nodes.h>
#include <fiberloom/model/system.h>

#include <algorithm>
#include <type_traits>

namespace fiberloom
{
  // How System adds a group of nodes, for those of its sources that have some.

  template <bool with_tangent, class Group>
  void
  System::scatter(const State                  &state,
                  const Group                  &group,
                  const std::vector<NodeImage> &images)
  {
    // Blocks of nine where the group knows that it has no others.
    constexpr int n_fixed =
      std::decay_t<decltype(group.force(0))>::RowsAtCompileTime;
    using Force = Eigen::Matrix<double, n_fixed, 1>;
    using Block = Eigen::Matrix<double, n_fixed, n_fixed, Eigen::RowMajor>;
    const unsigned int n_nodes = group.nodes.size();

    const auto original = [&images](const unsigned int node) {
      return node < images.size() ? images[node].node : node;
    };
    const bool held =
      std::any_of(group.nodes.begin(),
                  group.nodes.end(),
                  [&](const unsigned int node) {
                    return movement.attachment(original(node)) >= 0 ||
                           (!images.empty() &&
                            images[node].periods != std::array<int, 2>());
                  });
    if (held)
      {
        HeldGroup transformed(group.nodes.data(),
                              n_nodes,
                              movement.attachments(),
                              supports,
                              numbering,
                              images);
        for (unsigned int a = 0; a < n_nodes; ++a)
          transformed.set_force(a, group.force(a));
        if constexpr (with_tangent)
          for (unsigned int a = 0; a < n_nodes; ++a)
            for (unsigned int b = 0; b < n_nodes; ++b)
              transformed.set_stiffness(a, b, group.stiffness(a, b));
        transformed.transform(state.q, state.placements, with_tangent);

        for (unsigned int a = 0; a < transformed.n_blocks(); ++a)
          {
            const unsigned int row   = transformed.block(a);
            const int          local = numbering.local_block(row);
            if (local < 0)
              continue;
            Eigen::Map<Eigen::VectorXd>(residual.data() +
                                          numbering.local_first_dof(local),
                                        numbering.size(row)) +=
              transformed.force(a);
            if constexpr (with_tangent)
              for (unsigned int b = 0; b < transformed.n_blocks(); ++b)
                Eigen::Map<Eigen::Matrix<double,
                                         Eigen::Dynamic,
                                         Eigen::Dynamic,
                                         Eigen::RowMajor>>(
                  system_matrix.block(row, transformed.block(b)),
                  numbering.size(row),
                  numbering.size(transformed.block(b))) +=
                  transformed.stiffness(a, b);
          }
        return;
      }

    for (unsigned int a = 0; a < n_nodes; ++a)
      {
        const unsigned int row   = original(group.nodes[a]);
        const int          local = numbering.local_block(row);
        if (local < 0)
          continue;
        Eigen::Map<Force>(residual.data() + numbering.local_first_dof(local),
                          numbering.size(row)) += group.force(a);
        if constexpr (with_tangent)
          for (unsigned int b = 0; b < n_nodes; ++b)
            {
              const unsigned int column = original(group.nodes[b]);
              Eigen::Map<Block>(system_matrix.block(row, column),
                                numbering.size(row),
                                numbering.size(column)) +=
                group.stiffness(a, b);
            }
      }
  }
} // namespace fiberloom

#endif
