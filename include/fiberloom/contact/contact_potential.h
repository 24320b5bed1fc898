// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_contact_contact_potential_h
#define fiberloom_contact_contact_potential_h

#include <fiberloom/base/curvature.h>

#include <fiberloom/contact/contact_law.h>
#include <fiberloom/contact/line_weights.h>

#include <array>

namespace fiberloom
{
  /**
   * Gradient and Hessian of a contact's energy by the nodes, where points
   * follow the fibers. By the two sections x (see SectionPair) and those along
   * the fibers x', the Hessian is H + l y^T + y l^T with y the slide of the
   * points and l the forces times the sections' slopes; node a has the part N_a
   * x and N_a' x'. Section 4.4 of the theory.
   */
  struct ContactPotential
  {
    static constexpr unsigned int most_nodes = 2 * LineWeights::most_nodes;

    using Block  = Eigen::Matrix<double, 9, 9>;
    using Blocks = std::array<std::array<Block, 2>, 2>;

    unsigned int                          n = 0;
    std::array<unsigned int, most_nodes>  nodes;
    std::array<unsigned char, most_nodes> fiber; // 0 or 1
    std::array<double, most_nodes>        value, first;

    /** The 9 x 9 block of the Hessian by the nodes @p a and @p b [N/mm]. */
    Block
    block(const unsigned int a, const unsigned int b) const
    {
      const unsigned int s = fiber[a], r = fiber[b];
      return (value[a] * value[b]) * both[s][r] +
             (first[a] * value[b]) * row[s][r] +
             (value[a] * first[b]) * column[s][r];
    }

    SectionPair residual;
    Blocks      both;        // of N_a N_b, by the fibers of a and b
    Blocks      row, column; // of N_a' N_b, and of N_a N_b'
    SectionPair force_slope; // derivative of the normal force by N_a x
  };

  /** Moves the points of @p contact to where they belong at @p q . */
  void
  follow_points(ContactElement  &contact,
                const FiberMesh &mesh,
                const DofVector &q);

  /**
   * Energy of normal contact [N mm]: psi(g) for the distance of the points
   * less the support of both cut sections, g = |d| - h1 - h2 with
   * h_i^2 = ((d.r g1)^2 + (d.r g2)^2) / (d.d - (d.t_i)^2). Moves the points;
   * stores gap and force in @p contact .
   */
  double
  normal_energy(ContactElement  &contact,
                const FiberMesh &mesh,
                const DofVector &q);

  /**
   * Exact gradient and, as @p curvature says, Hessian of that. Moves the
   * points; stores gap, force, normal and status. False, with nothing else set,
   * where the contact is open and not predicted to close.
   */
  bool
  evaluate_normal(ContactElement   &contact,
                  const FiberMesh  &mesh,
                  const DofVector  &q,
                  ContactPotential &potential,
                  const Curvature   curvature);
} // namespace fiberloom

#endif
