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

    /** Of unknown number @p i of a node, which of the heights it moves, or -1,
     * and how far. */
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

    static unsigned int
    size(const unsigned int node)
    {
      return node == 3 ? 6 : 9;
    }

    Eigen::VectorXd
    force(const unsigned int a) const
    {
      Eigen::VectorXd force = Eigen::VectorXd::Zero(size(a));
      for (unsigned int i = 0; i < size(a); ++i)
        if (const auto [k, weight] = moved(a, i); k >= 0)
          force[i] = weight * gradient[k];
      return force;
    }

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

  /** What its friction adds: the section spread over the nodes. */
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

    auto
    force(const unsigned int a) const
    {
      return weights[a] * gradient;
    }

    auto
    stiffness(const unsigned int a, const unsigned int b) const
    {
      return (weights[a] * weights[b]) * hessian;
    }
  };
} // namespace fiberloom

#endif
