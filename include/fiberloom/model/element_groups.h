// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_model_element_groups_h
#define fiberloom_model_element_groups_h

#include <fiberloom/beams/beam_element.h>

#include <fiberloom/contact/contact_law.h>
#include <fiberloom/contact/contact_potential.h>

#include <fiberloom/model/block_layout.h>
#include <fiberloom/model/composite.h>

#include <array>
#include <vector>

namespace fiberloom
{
  // What terms add to an Assembly: groups of nodes with their part of the
  // residual and of the tangent, block by block. Each group has
  //
  //   nodes           the n nodes by number, see BlockLayout,
  //   force(a)        the gradient of its energy by the dofs of node a [N],
  //   stiffness(a, b) the Hessian by the dofs of nodes a and b [N/mm],
  //
  // where a and b count the nodes of the group from 0. A block has 9 dofs for
  // a fiber node (x0, r g1, r g2) and 3 for a node of the matrix. Where all
  // blocks have nine dofs, their types say so.

  /**
   * A beam element's contribution: blocks cut from its own matrices. Section
   * 1.7 of the theory.
   */
  struct ElementGroup
  {
    static constexpr unsigned int n_nodes = 3;

    std::array<unsigned int, n_nodes> nodes;
    BeamElement::Vector               residual;
    BeamElement::Matrix               tangent;

    /** The nine entries of node @p a [N]. */
    auto
    force(const unsigned int a) const
    {
      return residual.segment<9>(9 * a);
    }

    /** The 9 x 9 block of nodes @p a and @p b [N/mm]. */
    auto
    stiffness(const unsigned int a, const unsigned int b) const
    {
      return tangent.block<9, 9>(9 * a, 9 * b);
    }
  };

  /**
   * A contact's contribution: the pair of sections spread over the three nodes
   * of each fiber's element by the weights of the shape functions. Section 2.5
   * of the theory.
   */
  struct ContactGroup
  {
    static constexpr unsigned int n_nodes = 6;

    std::array<unsigned int, n_nodes> nodes;
    std::array<double, n_nodes>       weights;
    SectionPair                       residual;
    SectionPair2                      tangent;

    /**
     * Takes nodes and weights from @p contact . Residual and tangent, by the 18
     * dofs of the two sections, are left to evaluate_contact().
     */
    explicit ContactGroup(const ContactElement &contact)
    {
      for (unsigned int a = 0; a < n_nodes; ++a)
        {
          nodes[a]   = contact.first_nodes[a / 3] + a % 3;
          weights[a] = contact.weights[a / 3][a % 3];
        }
    }

    /** Weight of node @p a times the nine entries of its section [N]. */
    auto
    force(const unsigned int a) const
    {
      return weights[a] * residual.segment<9>(9 * (a / 3));
    }

    /** Both weights times the 9 x 9 block of the two sections [N/mm]. */
    auto
    stiffness(const unsigned int a, const unsigned int b) const
    {
      return (weights[a] * weights[b]) *
             tangent.block<9, 9>(9 * (a / 3), 9 * (b / 3));
    }
  };

  /**
   * The contribution of a contact whose points follow the fibers, see
   * ContactPotential. Section 4.4 of the theory.
   */
  struct PotentialGroup
  {
    ContactPotential          potential;
    std::vector<unsigned int> nodes;

    /** Copies the nodes that the potential has. */
    void
    set_nodes()
    {
      nodes.assign(potential.nodes.begin(),
                   potential.nodes.begin() + potential.n);
    }

    /**
     * Shape function of node @p a times the nine entries of its section [N].
     */
    Eigen::Matrix<double, 9, 1>
    force(const unsigned int a) const
    {
      return potential.value[a] *
             potential.residual.segment<9>(9 * potential.fiber[a]);
    }

    /** The 9 x 9 block of nodes @p a and @p b [N/mm]. */
    Eigen::Matrix<double, 9, 9>
    stiffness(const unsigned int a, const unsigned int b) const
    {
      return potential.block(a, b);
    }
  };

  /** A dead force on the centre of a node. */
  struct NodeGroup
  {
    static constexpr unsigned int n_nodes = 1;

    std::array<unsigned int, n_nodes> nodes;
    Vector3                           outer_force;

    /**
     * The residual of an outer force is its negative [N]; it acts on x0 alone.
     */
    Eigen::Matrix<double, 9, 1>
    force(const unsigned int) const
    {
      Eigen::Matrix<double, 9, 1> force = Eigen::Matrix<double, 9, 1>::Zero();
      force.head<3>()                   = -outer_force;
      return force;
    }

    /** Zero, since the force is dead. */
    Eigen::Matrix<double, 9, 9>
    stiffness(const unsigned int, const unsigned int) const
    {
      return Eigen::Matrix<double, 9, 9>::Zero();
    }
  };

  /** A cell's contribution: any number of nodes of fibers and of the matrix. */
  struct MixedGroup
  {
    std::vector<unsigned int> nodes;
    std::vector<unsigned int> offsets; // of their dofs
    Eigen::VectorXd           residual;
    Eigen::MatrixXd           tangent;

    /**
     * Sets nodes, and where the dofs of each begin in the residual and the
     * tangent, which are left to the caller.
     */
    void
    set_nodes(const std::vector<unsigned int> &node_numbers,
              const BlockLayout               &layout)
    {
      nodes = node_numbers;
      offsets.assign(1, 0);
      for (const unsigned int node : nodes)
        offsets.push_back(offsets.back() + layout.size(node));
    }

    /** Number of dofs of node @p a : 9 or 3. */
    unsigned int
    size(const unsigned int a) const
    {
      return offsets[a + 1] - offsets[a];
    }

    /** The size( @p a ) entries of node @p a [N]. */
    auto
    force(const unsigned int a) const
    {
      return residual.segment(offsets[a], size(a));
    }

    /** The size( @p a ) x size( @p b ) block of nodes @p a and @p b [N/mm]. */
    auto
    stiffness(const unsigned int a, const unsigned int b) const
    {
      return tangent.block(offsets[a], offsets[b], size(a), size(b));
    }
  };

  /**
   * The nodes of cell number @p cell of the matrix, numbered as in the system.
   */
  inline std::vector<unsigned int>
  nodes_of_cell(const Composite &composite, const unsigned int cell)
  {
    std::vector<unsigned int> nodes = composite.matrix().nodes(cell);
    for (unsigned int &node : nodes)
      node += composite.first_node();
    return nodes;
  }

  /**
   * The nodes of @p junction , numbered as in the system: three of the fiber,
   * then those of the matrix.
   */
  inline std::vector<unsigned int>
  nodes_of_junction(const Composite &composite, const JunctionElement &junction)
  {
    std::vector<unsigned int> nodes(junction.fiber_nodes().begin(),
                                    junction.fiber_nodes().end());
    for (const unsigned int node : junction.matrix_nodes())
      nodes.push_back(composite.first_node() + node);
    return nodes;
  }

  /**
   * A junction: a spring k between a particle of a fiber and one of the matrix,
   * the same along each axis, spread over the nodes by weights. Section 6.3 of
   * the theory.
   */
  struct JunctionGroup
  {
    std::vector<unsigned int> nodes;
    Vector3                   fiber_force;

    /**
     * Junction number @p junction where fibers and matrix are at @p q , see
     * State. Keeps references to the junction and to @p layout .
     */
    JunctionGroup(const Composite   &composite,
                  const unsigned int junction,
                  const DofVector   &q,
                  const BlockLayout &layout)
      : nodes(nodes_of_junction(composite, composite.junctions()[junction]))
      , fiber_force(composite.junction_force(junction, q))
      , element(composite.junctions()[junction])
      , layout(layout)
    {}

    /** Number of dofs of node @p a : 9 for a fiber, 3 for the matrix. */
    unsigned int
    size(const unsigned int a) const
    {
      return layout.size(nodes[a]);
    }

    /**
     * Weight of vector number @p v of node @p a , see
     * JunctionElement::weights(): of x0, r g1 or r g2 where @p a < 3, else of
     * the one position ( @p v = 0).
     */
    double
    weight(const unsigned int a, const unsigned int v) const
    {
      return element.weights()[a < 3 ? 3 * a + v : 6 + a];
    }

    /**
     * By which multiple of the 3 x 3 unit matrix vector @p v of node @p a and
     * vector @p w of node @p b are coupled [N/mm].
     */
    double
    stiffness_of(const unsigned int a,
                 const unsigned int v,
                 const unsigned int b,
                 const unsigned int w) const
    {
      return element.spring() * weight(a, v) * weight(b, w);
    }

    /** The size( @p a ) entries of node @p a [N]. */
    Eigen::VectorXd
    force(const unsigned int a) const
    {
      Eigen::VectorXd force(size(a));
      for (unsigned int v = 0; v < size(a) / 3; ++v)
        force.segment<3>(3 * v) = -weight(a, v) * fiber_force;
      return force;
    }

    /** The size( @p a ) x size( @p b ) block of nodes @p a and @p b [N/mm]. */
    Eigen::MatrixXd
    stiffness(const unsigned int a, const unsigned int b) const
    {
      Eigen::MatrixXd block = Eigen::MatrixXd::Zero(size(a), size(b));
      for (unsigned int v = 0; v < size(a) / 3; ++v)
        for (unsigned int w = 0; w < size(b) / 3; ++w)
          block.block<3, 3>(3 * v, 3 * w)
            .diagonal()
            .setConstant(stiffness_of(a, v, b, w));
      return block;
    }

  private:
    const JunctionElement &element;
    const BlockLayout     &layout;
  };
} // namespace fiberloom

#endif
