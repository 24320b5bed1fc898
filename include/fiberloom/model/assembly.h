// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_model_assembly_h
#define fiberloom_model_assembly_h

#include <fiberloom/beams/beam_element.h>

#include <fiberloom/model/block_matrix.h>
#include <fiberloom/model/held_nodes.h>
#include <fiberloom/model/motion.h>

#include <algorithm>
#include <array>
#include <type_traits>
#include <vector>

namespace fiberloom
{
  /**
   * Where the terms of a system add up: residual and, if asked for, tangent of
   * the blocks that this rank owns. What a term adds are groups of nodes with
   * forces and stiffnesses; those of nodes that bodies hold, or that are images
   * of others, go where they belong. All arguments are kept by reference.
   */
  class Assembly
  {
  public:
    /**
     * Arguments are kept by reference. Residual and tangent are those of the
     * blocks that this rank owns in @p layout .
     */
    Assembly(const Motion      &motion,
             const Supports    &supports,
             const BlockLayout &layout,
             BlockMatrix       &matrix);

    /**
     * From here on, only what touches one of @p blocks adds up, the tangent in
     * @p matrix ; @p blocks has one entry for each block of the layout, or none
     * if all of them count.
     */
    void
    restrict_to(std::vector<char> blocks, BlockMatrix &matrix);

    bool
    is_restricted() const
    {
      return !taken.empty();
    }

    /** Whether what touches @p block adds up. */
    bool
    takes(const unsigned int block) const
    {
      return taken.empty() || taken[block];
    }

    /**
     * Starts a sum from zero at @p state , which has to stay until all is
     * added. @p curvature : of the tangent of fibers, and of contacts whose
     * points follow them; none: no tangent.
     */
    void
    begin(const State &state, const Curvature curvature);

    /**
     * Goes on with the sum that is there, the tangent included, at @p state as
     * in begin().
     */
    void
    go_on(const State &state)
    {
      this->state  = &state;
      adds_tangent = true;
    }

    /** Whether a tangent is asked for in addition to the residual. */
    bool
    with_tangent() const
    {
      return adds_tangent;
    }

    /** Which part of the Hessian the tangent is to have, see begin(). */
    Curvature
    curvature() const
    {
      return curvature_of_energy;
    }

    /** The tangent: [N/mm] between displacements, see BlockMatrix. */
    BlockMatrix &
    matrix()
    {
      return *tangent;
    }

    /**
     * Whether this rank owns a block to which the @p n nodes at @p nodes add
     * something: one of them, or the body or cell that moves it. Always false
     * where the sum is restricted to other blocks. @p images : what the nodes
     * are images of; empty where they are nodes of the system. scatter() takes
     * the same.
     */
    bool
    touches_owned(const unsigned int           *nodes,
                  const unsigned int            n,
                  const std::vector<NodeImage> &images = {}) const;

    /** Whether bodies hold any of @p nodes , or some are images across a border
     * of a cell. */
    template <class Nodes>
    bool
    is_held(const Nodes &nodes, const std::vector<NodeImage> &images) const
    {
      return std::any_of(
        nodes.begin(), nodes.end(), [&](const unsigned int node) {
          return motion.attachment(original(node, images)) >= 0 ||
                 (node < images.size() &&
                  images[node].periods != std::array<int, 2>());
        });
    }

    /**
     * Adds force(a) and, where a tangent is asked for, stiffness(a, b) of the
     * nodes of @p group to the owned rows; see element_groups.h for shapes and
     * units. What acts on held nodes and images goes to the unknowns that move
     * them, see HeldGroup. All blocks have to be in the pattern of the matrix.
     */
    template <class Group>
    void
    scatter(const Group &group, const std::vector<NodeImage> &images = {});

    /** A group of @p nodes for add_product(), whose forces are zero so far. */
    HeldGroup
    held_group(const std::vector<unsigned int> &nodes,
               const std::vector<NodeImage>    &images) const;

    /**
     * Adds the product rows * columns^T of two vectors, given as forces of the
     * same nodes, to products of the tangent, see
     * BlockMatrix::add_outer_product(). Fixed dofs have no part in it.
     * Transforms both groups.
     */
    void
    add_product(HeldGroup &rows, HeldGroup &columns);

    /**
     * The residual of the owned block number @p local_block , as many entries
     * as it has dofs [N], for what adds to it without a group.
     */
    double *
    forces(const unsigned int local_block)
    {
      return sum.data() + layout.local_first_dof(local_block);
    }

    /** Notes a force inside an element or from outside [N]. */
    void
    note_force(const double force)
    {
      largest = std::max(largest, force);
    }

    /** The largest force noted since begin() [N]. */
    double
    largest_force() const
    {
      return largest;
    }

    /** Makes largest_force() that of all ranks. Collective. */
    void
    reduce_largest_force();

    /** The residual by owned dofs: forces [N], moments on bodies [N mm]. */
    const std::vector<double> &
    residual() const
    {
      return sum;
    }

    /** Exchanges the residual with @p other , which has as many entries. */
    void
    swap_residual(std::vector<double> &other)
    {
      sum.swap(other);
    }

    const Motion      &motion;
    const BlockLayout &layout;

  private:
    const Supports     &supports;
    BlockMatrix        *tangent;
    std::vector<char>   taken; // blocks; empty: all
    const State        *state               = nullptr;
    bool                adds_tangent        = false;
    Curvature           curvature_of_energy = Curvature::exact;
    std::vector<double> sum; // of residuals, the owned dofs
    double              largest = 0;

    static unsigned int
    original(const unsigned int node, const std::vector<NodeImage> &images)
    {
      return node < images.size() ? images[node].node : node;
    }

    template <class Group>
    void
    scatter_held(const Group &group, const std::vector<NodeImage> &images);
  };



  template <class Group>
  void
  Assembly::scatter_held(const Group                  &group,
                         const std::vector<NodeImage> &images)
  {
    using Block =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const unsigned int n_nodes = group.nodes.size();
    HeldGroup          transformed({group.nodes.data(), n_nodes},
                          motion.attachments(),
                          supports,
                          layout,
                          images);
    for (unsigned int a = 0; a < n_nodes; ++a)
      transformed.set_force(a, group.force(a));
    if (adds_tangent)
      for (unsigned int a = 0; a < n_nodes; ++a)
        for (unsigned int b = 0; b < n_nodes; ++b)
          transformed.set_stiffness(a, b, group.stiffness(a, b));
    transformed.transform(state->q,
                          state->placements,
                          adds_tangent ?
                            HeldGroup::Parts::forces_and_stiffness :
                            HeldGroup::Parts::forces);

    for (unsigned int a = 0; a < transformed.n_blocks(); ++a)
      {
        const unsigned int row   = transformed.block(a);
        const int          local = layout.local_block(row);
        if (local < 0)
          continue;
        Eigen::Map<Eigen::VectorXd>(forces(local), layout.size(row)) +=
          transformed.force(a);
        if (adds_tangent)
          for (unsigned int b = 0; b < transformed.n_blocks(); ++b)
            Eigen::Map<Block>(tangent->block(row, transformed.block(b)),
                              layout.size(row),
                              layout.size(transformed.block(b))) +=
              transformed.stiffness(a, b);
      }
  }



  template <class Group>
  void
  Assembly::scatter(const Group &group, const std::vector<NodeImage> &images)
  {
    // Blocks of nine where the group knows that it has no others.
    constexpr int n_fixed =
      std::decay_t<decltype(group.force(0))>::RowsAtCompileTime;
    using Force = Eigen::Matrix<double, n_fixed, 1>;
    using Block = Eigen::Matrix<double, n_fixed, n_fixed, Eigen::RowMajor>;

    if (is_held(group.nodes, images))
      {
        scatter_held(group, images);
        return;
      }
    for (unsigned int a = 0; a < group.nodes.size(); ++a)
      {
        const unsigned int row   = original(group.nodes[a], images);
        const int          local = layout.local_block(row);
        if (local < 0)
          continue;
        Eigen::Map<Force>(forces(local), layout.size(row)) += group.force(a);
        if (adds_tangent)
          for (unsigned int b = 0; b < group.nodes.size(); ++b)
            {
              const unsigned int column = original(group.nodes[b], images);
              Eigen::Map<Block>(tangent->block(row, column),
                                layout.size(row),
                                layout.size(column)) += group.stiffness(a, b);
            }
      }
  }
} // namespace fiberloom

#endif
