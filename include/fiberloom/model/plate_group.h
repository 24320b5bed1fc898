// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_model_plate_group_h
#define fiberloom_model_plate_group_h

#include <fiberloom/contact/plate_contact.h>
#include <fiberloom/contact/plate_friction.h>

#include <array>

namespace fiberloom
{
  /** What a section that touches a plate adds to an Assembly: three nodes of
   * its fiber, over which it is spread by weights, and the body of the plates.
   */
  struct PlateGroup
  {
    std::array<unsigned int, 4> nodes;
    std::array<double, 3>       weights;
    unsigned int                fiber;
    double                      u;      // of the section
    unsigned int                number; // among all sections and plates
    PlateFriction::Section      section;
    PlateContact::Heights       gradient;
    PlateContact::Hessian       hessian;

    /**
     * Which of the heights unknown number @p i of @p node moves, or -1, and by
     * how much.
     */
    std::pair<int, double>
    moved(const unsigned int node, const unsigned int i) const
    {
      if (node == 3)
        return i == 0 ? std::make_pair(3, 1.) :
               i == 2 ? std::make_pair(4, 1.) :
                        std::make_pair(-1, 0.);
      return i % 3 == 2 ? std::make_pair(int(i / 3), weights[node]) :
                          std::make_pair(-1, 0.);
    }

    /**
     * Number of unknowns of @p node : 6 for the plates' body, number 3, else 9.
     */
    static unsigned int
    size(const unsigned int node)
    {
      return node == 3 ? 6 : 9;
    }

    /**
     * Gradient of the energy by the unknowns of node @p a [N], size( @p a )
     * entries.
     */
    Eigen::VectorXd
    force(const unsigned int a) const
    {
      Eigen::VectorXd force = Eigen::VectorXd::Zero(size(a));
      for (unsigned int i = 0; i < size(a); ++i)
        if (const auto [k, weight] = moved(a, i); k >= 0)
          force[i] = weight * gradient[k];
      return force;
    }

    /**
     * Hessian of the energy by the unknowns of nodes @p a and @p b [N/mm],
     * size( @p a ) x size( @p b ).
     */
    Eigen::MatrixXd
    stiffness(const unsigned int a, const unsigned int b) const
    {
      Eigen::MatrixXd block = Eigen::MatrixXd::Zero(size(a), size(b));
      for (unsigned int i = 0; i < size(a); ++i)
        if (const auto [k, row] = moved(a, i); k >= 0)
          for (unsigned int j = 0; j < size(b); ++j)
            if (const auto [l, column] = moved(b, j); l >= 0)
              block(i, j) = row * column * hessian(k, l);
      return block;
    }
  };

  /**
   * What friction on a plate adds: the section spread over the three nodes of
   * its element by weights.
   */
  struct PlateFrictionGroup
  {
    std::array<unsigned int, 3> nodes;
    std::array<double, 3>       weights;
    PlateFriction::Section      gradient;
    PlateFriction::Hessian      hessian;

    explicit PlateFrictionGroup(const PlateGroup &group)
      : nodes{{group.nodes[0], group.nodes[1], group.nodes[2]}}
      , weights(group.weights)
    {}

    /** The nine entries of node @p a [N]. */
    auto
    force(const unsigned int a) const
    {
      return weights[a] * gradient;
    }

    /** The 9 x 9 block of nodes @p a and @p b [N/mm]. */
    auto
    stiffness(const unsigned int a, const unsigned int b) const
    {
      return (weights[a] * weights[b]) * hessian;
    }
  };
} // namespace fiberloom

#endif
