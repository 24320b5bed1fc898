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
  // residual and of the tangent, block by block. Where all blocks have nine
  // dofs, their types say so.

  /** A beam element's contribution: blocks cut from its own matrices. */
  struct ElementGroup
  {
    static constexpr unsigned int n_nodes = 3;

    std::array<unsigned int, n_nodes> nodes;
    BeamElement::Vector               residual;
    BeamElement::Matrix               tangent;

    auto
    force(const unsigned int a) const
    {
      return residual.segment<9>(9 * a);
    }

    auto
    stiffness(const unsigned int a, const unsigned int b) const
    {
      return tangent.block<9, 9>(9 * a, 9 * b);
    }
  };

  /** A contact's: the pair of sections spread over the nodes by weights. */
  struct ContactGroup
  {
    static constexpr unsigned int n_nodes = 6;

    std::array<unsigned int, n_nodes> nodes;
    std::array<double, n_nodes>       weights;
    SectionPair                       residual;
    SectionPair2                      tangent;

    explicit ContactGroup(const ContactElement &contact)
    {
      for (unsigned int a = 0; a < n_nodes; ++a)
        {
          nodes[a]   = contact.first_nodes[a / 3] + a % 3;
          weights[a] = contact.weights[a / 3][a % 3];
        }
    }

    auto
    force(const unsigned int a) const
    {
      return weights[a] * residual.segment<9>(9 * (a / 3));
    }

    auto
    stiffness(const unsigned int a, const unsigned int b) const
    {
      return (weights[a] * weights[b]) *
             tangent.block<9, 9>(9 * (a / 3), 9 * (b / 3));
    }
  };

  /** That of one whose points follow the fibers. */
  struct PotentialGroup
  {
    ContactPotential          potential;
    std::vector<unsigned int> nodes;

    void
    set_nodes()
    {
      nodes.assign(potential.nodes.begin(),
                   potential.nodes.begin() + potential.n);
    }

    Eigen::Matrix<double, 9, 1>
    force(const unsigned int a) const
    {
      return potential.value[a] *
             potential.residual.segment<9>(9 * potential.fiber[a]);
    }

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

    Eigen::Matrix<double, 9, 1>
    force(const unsigned int) const
    {
      Eigen::Matrix<double, 9, 1> force = Eigen::Matrix<double, 9, 1>::Zero();
      force.head<3>()                   = -outer_force;
      return force;
    }

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

    void
    set_nodes(const std::vector<unsigned int> &node_numbers,
              const BlockLayout               &layout)
    {
      nodes = node_numbers;
      offsets.assign(1, 0);
      for (const unsigned int node : nodes)
        offsets.push_back(offsets.back() + layout.size(node));
    }

    unsigned int
    size(const unsigned int a) const
    {
      return offsets[a + 1] - offsets[a];
    }

    auto
    force(const unsigned int a) const
    {
      return residual.segment(offsets[a], size(a));
    }

    auto
    stiffness(const unsigned int a, const unsigned int b) const
    {
      return tangent.block(offsets[a], offsets[b], size(a), size(b));
    }
  };

  inline std::vector<unsigned int>
  nodes_of_cell(const Composite &composite, const unsigned int cell)
  {
    std::vector<unsigned int> nodes = composite.matrix().nodes(cell);
    for (unsigned int &node : nodes)
      node += composite.first_node();
    return nodes;
  }

  inline std::vector<unsigned int>
  nodes_of_junction(const Composite &composite, const JunctionElement &junction)
  {
    std::vector<unsigned int> nodes(junction.fiber_nodes().begin(),
                                    junction.fiber_nodes().end());
    for (const unsigned int node : junction.matrix_nodes())
      nodes.push_back(composite.first_node() + node);
    return nodes;
  }

  /** A junction: the same spring along each axis, spread by weights. */
  struct JunctionGroup
  {
    std::vector<unsigned int> nodes;
    Vector3                   fiber_force;

    JunctionGroup(const Composite   &composite,
                  const unsigned int junction,
                  const DofVector   &q,
                  const BlockLayout &layout)
      : nodes(nodes_of_junction(composite, composite.junctions()[junction]))
      , fiber_force(composite.junction_force(junction, q))
      , element(composite.junctions()[junction])
      , layout(layout)
    {}

    unsigned int
    size(const unsigned int a) const
    {
      return layout.size(nodes[a]);
    }

    /** Of vector number @p v of node @p a , see JunctionElement::weights(). */
    double
    weight(const unsigned int a, const unsigned int v) const
    {
      return element.weights()[a < 3 ? 3 * a + v : 6 + a];
    }

    double
    stiffness_of(const unsigned int a,
                 const unsigned int v,
                 const unsigned int b,
                 const unsigned int w) const
    {
      return element.spring() * weight(a, v) * weight(b, w);
    }

    Eigen::VectorXd
    force(const unsigned int a) const
    {
      Eigen::VectorXd force(size(a));
      for (unsigned int v = 0; v < size(a) / 3; ++v)
        force.segment<3>(3 * v) = -weight(a, v) * fiber_force;
      return force;
    }

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
