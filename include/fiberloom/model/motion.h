// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_model_motion_h
#define fiberloom_model_motion_h

#include <fiberloom/beams/fiber_mesh.h>

#include <fiberloom/coupling/rigid_body.h>

#include <fiberloom/model/block_layout.h>
#include <fiberloom/model/held_nodes.h>
#include <fiberloom/model/state.h>

#include <vector>

namespace fiberloom
{
  /**
   * How the unknowns of a System move fibers and bodies: which node is held by
   * which body, which dofs are fixed, and what an increment of all dofs does to
   * a state.
   */
  class Motion
  {
  public:
    /**
     * References are kept. @p originals : what each node is the image of; empty
     * without a cell.
     */
    Motion(const FiberMesh              &mesh,
           const Supports               &supports,
           const BlockLayout            &layout,
           const std::vector<NodeImage> &originals);

    /** Index into the attachments of the supports by node; -1: free. */
    const std::vector<int> &
    attachments() const
    {
      return node_attachments;
    }

    /**
     * Index of the attachment of @p node ; -1 where it is free, and for the
     * block of a body.
     */
    int
    attachment(const unsigned int node) const
    {
      return node < node_attachments.size() ? node_attachments[node] : -1;
    }

    /** Index of the body that holds @p node ; -1: none. */
    int
    holding_body(const unsigned int node) const
    {
      return node_attachments[node] < 0 ?
               -1 :
               int(supports.attachments[node_attachments[node]].body);
    }

    /**
     * Whether the unknown number @p dof of the system is fixed or prescribed.
     */
    bool
    is_fixed(const unsigned int dof) const
    {
      return fixed[dof];
    }

    /** Whether one of the unknowns of @p block is. */
    bool
    has_fixed(const unsigned int block) const
    {
      return blocks_with_fixed[block];
    }

    /**
     * Increments of the bodies' fixed dofs to their targets [mm], [rad], 0 for
     * all others.
     */
    std::vector<double>
    prescribed_increments(const State &state, const Targets &targets) const;

    /** Whether some prescribed dof is not where its target is. */
    bool
    moves(const State &state, const Targets &targets) const;

    /** Whether the unknowns of @p node are those of its original, one period
     * away. */
    bool
    is_image(const unsigned int node) const
    {
      return supports.cell && node < originals.size() &&
             originals[node].node != node;
    }

    /** Whether there is a cell, and no body holds a place in it. */
    bool
    is_periodic() const
    {
      return supports.cell.has_value();
    }

    /** Largest change of x0, r g1 or r g2 of each fiber's nodes over its radius
     * by @p increment . */
    std::vector<double>
    largest_moves(const Eigen::VectorXd &increment) const;

    /** The largest of these, and of a cell's elongations and of plates, too, if
     * it has them. */
    double
    largest_move(const Eigen::VectorXd &increment) const;

    /** The same by the increment that takes bodies to @p targets . */
    double
    largest_prescribed_move(const State &state, const Targets &targets) const;

    /** Adds @p factor times @p increment to @p state . */
    void
    advance(State                 &state,
            const Eigen::VectorXd &increment,
            const double           factor) const;

    /**
     * Moves the prescribed dofs of @p state to their targets, the others as
     * much further, over @p load_step , as they had come from @p past .
     */
    void
    extrapolate(State         &state,
                const Past    &past,
                const Targets &targets,
                const double   load_step) const;

  private:
    /** Puts the images of @p state to where their originals and the elongations
     * of the cell have them. */
    void
    place_images(State &state) const;

    /** The dofs of a node, zeros behind the three of one of the matrix. */
    NodeVector
    node_dofs(const Eigen::VectorXd &dofs, const unsigned int node) const;

    const FiberMesh              &mesh;
    const Supports               &supports;
    const BlockLayout            &layout;
    const std::vector<NodeImage> &originals; // of all nodes
    std::vector<int>              node_attachments;
    std::vector<bool>             fixed;
    std::vector<bool>             blocks_with_fixed;
  };
} // namespace fiberloom

#endif
