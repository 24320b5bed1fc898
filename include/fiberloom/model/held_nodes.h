// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_model_held_nodes_h
#define fiberloom_model_held_nodes_h

#include <fiberloom/fabric/fiber_images.h>

#include <fiberloom/coupling/rigid_body.h>

#include <fiberloom/model/block_layout.h>

#include <deal.II/base/array_view.h>

#include <vector>

namespace fiberloom
{
  using NodeVector = Eigen::Matrix<double, 9, 1>;

  /** cross_matrix(v) w = v x w. */
  Matrix3
  cross_matrix(const Vector3 &v);

  /**
   * The dofs of a held node after its body went from @p before to @p after and
   * its components along the attachment's frame changed by @p local_change .
   */
  NodeVector
  move_held_node(const Attachment &attachment,
                 const Placement  &before,
                 const Placement  &after,
                 const NodeVector &dofs,
                 const NodeVector &local_change);

  /**
   * The local change with which move_held_node() goes from @p dofs_before to
   * @p dofs_after , to first order.
   */
  NodeVector
  local_change(const Attachment &attachment,
               const Placement  &before,
               const Placement  &after,
               const NodeVector &dofs_before,
               const NodeVector &dofs_after);

  /**
   * Forces and stiffness of a group of nodes, of fibers or of the matrix, some
   * of which are held by rigid bodies, transformed to the unknowns of System:
   * dq = F dq_local + dc + dtheta x (q - c), with the second derivative of the
   * rotation in the tangent, since the map from the unknowns to the dofs is not
   * linear. Images in a periodic cell go with their originals and with the
   * elongations of the cell, which is linear.
   */
  class HeldGroup
  {
  public:
    /** What is transformed. */
    enum class Parts
    {
      forces,
      forces_and_stiffness
    };

    /** @p images : what each node is the image of; empty where @p nodes are
     * originals. */
    HeldGroup(const dealii::ArrayView<const unsigned int> &nodes,
              const std::vector<int>                      &attachment_of_node,
              const Supports                              &supports,
              const BlockLayout                           &layout,
              const std::vector<NodeImage>                &images = {});

    template <class Vector>
    void
    set_force(const unsigned int a, const Vector &value)
    {
      forces.segment(offset(a), size(a)) = value;
    }

    template <class Matrix>
    void
    set_stiffness(const unsigned int a,
                  const unsigned int b,
                  const Matrix      &value)
    {
      matrix.block(offset(a), offset(b), size(a), size(b)) = value;
    }

    void
    transform(const DofVector              &q,
              const std::vector<Placement> &placements,
              const Parts                   parts);

    unsigned int
    n_blocks() const
    {
      return blocks.size();
    }

    unsigned int
    block(const unsigned int a) const
    {
      return blocks[a];
    }

    Eigen::VectorXd
    force(const unsigned int a) const
    {
      return forces.segment(offset(a), size(a));
    }

    Eigen::MatrixXd
    stiffness(const unsigned int a, const unsigned int b) const
    {
      return matrix.block(offset(a), offset(b), size(a), size(b));
    }

  private:
    unsigned int
    offset(const unsigned int a) const
    {
      return offsets[a];
    }

    unsigned int
    size(const unsigned int a) const
    {
      return offsets[a + 1] - offsets[a];
    }

    /** Of a body among the blocks, where it is added if it is not there. */
    unsigned int
    position_of_body(const unsigned int block);

    /** Of the held node @p a with so many dofs. */
    template <int n_dofs>
    void
    transform_node(const unsigned int            a,
                   const DofVector              &q,
                   const std::vector<Placement> &placements,
                   const Parts                   parts,
                   Eigen::MatrixXd              &geometric);

    /** Of the node @p a that goes with the cell. */
    template <int n_dofs>
    void
    transform_carried(const unsigned int a, const Parts parts);

    /** Of a node with these changes of its dofs by its unknowns, which replace
     * them, and by those of its body. */
    template <int n_dofs>
    void
    apply(const unsigned int                           a,
          const Eigen::Matrix<double, n_dofs, n_dofs> &basis,
          const Eigen::Matrix<double, n_dofs, 6>      &motion,
          const Parts                                  parts);

    const unsigned int                  n_nodes;
    const Supports                     &supports;
    const BlockLayout                  &layout;
    std::vector<unsigned int>           blocks;  // nodes, then bodies
    std::vector<unsigned int>           offsets; // of their dofs
    std::vector<const Attachment *>     held;    // by node, null if free
    std::vector<std::optional<Matrix3>> carried; // by node, with the cell
    std::vector<unsigned int> body_position;     // of a held node, in blocks
    Eigen::VectorXd           forces;
    Eigen::MatrixXd           matrix;
  };
} // namespace fiberloom

#endif
