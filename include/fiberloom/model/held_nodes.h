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
  /**
   * The nine components of a fiber node: of its dofs x0, r g1, r g2 [mm], of
   * their change, or of the forces on them [N].
   */
  using NodeVector = Eigen::Matrix<double, 9, 1>;

  /** The matrix of the cross product: cross_matrix(v) w = v x w. */
  Matrix3
  cross_matrix(const Vector3 &v);

  /**
   * The dofs of a held node after its body went from @p before to @p after and
   * its components along the attachment's frame changed by @p local_change ,
   * all in [mm]. The motion is finite: the node follows its body rigidly.
   * Section 3.1 of the theory.
   */
  NodeVector
  move_held_node(const Attachment &attachment,
                 const Placement  &before,
                 const Placement  &after,
                 const NodeVector &dofs,
                 const NodeVector &local_change);

  /**
   * The local change [mm] with which move_held_node() goes from @p dofs_before
   * to @p dofs_after , to first order. Held components do not change.
   */
  NodeVector
  local_change(const Attachment &attachment,
               const Placement  &before,
               const Placement  &after,
               const NodeVector &dofs_before,
               const NodeVector &dofs_after);

  /**
   * Forces and stiffness of a group of nodes, of fibers or of the matrix, some
   * of which are held by rigid bodies, transformed to the unknowns of System.
   * Each of the vectors x0, r g1, r g2 of a held node moves by
   *
   *   dq = R F dq_local + dc + dtheta x (q - c),
   *
   * the section vectors without dc and c, where R is the rotation of the body
   * and F the frame of the attachment; so the forces become T^T f and the
   * stiffness T^T K T, section 3.1 of the theory. The second derivative of the
   * rotation is added to the tangent, since the map from the unknowns to the
   * dofs is not linear. Images in a periodic cell go with their originals and
   * with the elongations of the cell, which is linear.
   *
   * To use it, set forces and stiffness by the dofs of all nodes, call
   * transform() once, and add what force() and stiffness() then have for each
   * block.
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

    /**
     * @p nodes : nodes of the group, by number. @p attachment_of_node : index
     * into the attachments of @p supports by node of the system, -1 where it is
     * free, see Motion. @p images : what each node is the image of; empty where
     * @p nodes are originals. @p supports and @p layout are kept by reference.
     * Forces and stiffness begin as zero.
     */
    HeldGroup(const dealii::ArrayView<const unsigned int> &nodes,
              const std::vector<int>                      &attachment_of_node,
              const Supports                              &supports,
              const BlockLayout                           &layout,
              const std::vector<NodeImage>                &images = {});

    /**
     * Sets the force on node @p a of the group to @p value [N]: nine entries
     * for a fiber node, three for a node of the matrix.
     */
    template <class Vector>
    void
    set_force(const unsigned int a, const Vector &value)
    {
      forces.segment(offset(a), size(a)) = value;
    }

    /**
     * Sets the stiffness between the nodes @p a and @p b of the group to
     * @p value [N/mm]: 9 x 9 entries between fiber nodes, 3 x 3 between nodes
     * of the matrix, 9 x 3 or 3 x 9 in between.
     */
    template <class Matrix>
    void
    set_stiffness(const unsigned int a,
                  const unsigned int b,
                  const Matrix      &value)
    {
      matrix.block(offset(a), offset(b), size(a), size(b)) = value;
    }

    /**
     * Transforms what was set, by the dofs of all nodes, to the unknowns.
     * @p q : the dofs of all nodes, see State; @p placements : where the bodies
     * are. With Parts::forces the stiffness stays as it was set.
     */
    void
    transform(const DofVector              &q,
              const std::vector<Placement> &placements,
              const Parts                   parts);

    /**
     * Number of blocks that are touched: one for each node of the group, then
     * one for each body that moves some of them.
     */
    unsigned int
    n_blocks() const
    {
      return blocks.size();
    }

    /**
     * Number of the block in the layout; for an image it is that of its
     * original, so that several may be the same.
     */
    unsigned int
    block(const unsigned int a) const
    {
      return blocks[a];
    }

    /**
     * Force on block @p a , as many entries as the block has unknowns: 9 or 3
     * for a node [N], 6 for a body, three forces [N] and three moments about
     * its reference point [N mm].
     */
    Eigen::VectorXd
    force(const unsigned int a) const
    {
      return forces.segment(offset(a), size(a));
    }

    /**
     * Stiffness between the blocks @p a and @p b : [N/mm] between
     * displacements, [N] and [N mm] where rotations of bodies take part.
     */
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

    /**
     * Where the body's @p block is among the blocks; it is added if it is not
     * there.
     */
    unsigned int
    position_of_body(const unsigned int block);

    /**
     * Transforms forces and stiffness of the held node @p a , which has
     * @p n_dofs dofs; adds the second derivative of the rotation to
     * @p geometric .
     */
    template <int n_dofs>
    void
    transform_node(const unsigned int            a,
                   const DofVector              &q,
                   const std::vector<Placement> &placements,
                   const Parts                   parts,
                   Eigen::MatrixXd              &geometric);

    /**
     * Transforms forces and stiffness of node @p a , which goes with the cell.
     */
    template <int n_dofs>
    void
    transform_carried(const unsigned int a, const Parts parts);

    /**
     * Transforms forces and stiffness of node @p a : @p basis is the change of
     * its dofs by its unknowns, which replace them, @p motion that by the six
     * unknowns of its body.
     */
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
