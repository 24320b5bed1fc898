// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_beams_section_stiffness_h
#define fiberloom_beams_section_stiffness_h

#include <fiberloom/base/vector_types.h>

#include <Eigen/Core>

#include <array>

namespace fiberloom
{
  /**
   * Energy per unit of the axis of an affine round section, integrated over
   * the section, as a quadratic form of the 15 generalised strains.
   *
   * With q1..q5 = g1, g2, x0', g1', g2' these are e_ii = (q_i.q_i - ref)/2 and
   * e_ij = q_i.q_j - ref, in the order 11, 22, 33, 44, 55, 12, 13, 14, 15, 23,
   * 24, 25, 34, 35, 45. Then E11 = e11, E22 = e22, 2E12 = e12,
   * 2E13 = e13 + z1 e14 + z2 e15, 2E23 = e23 + z1 e24 + z2 e25 and
   * E33 = e33 + z1 e34 + z2 e35 + z1^2 e44 + z1 z2 e45 + z2^2 e55.
   *
   * Against Poisson locking (too stiff in bending by (1-nu)/((1+nu)(1-2nu)))
   * the section average of the strain sees the three-dimensional law D and the
   * rest sees D* = diag(E, E, E, G, G, G); this is the closed form of
   * condensing enhanced section strains that are linear over the section.
   * Sections 1.3 to 1.5 of the theory.
   */
  struct SectionStiffness
  {
    static constexpr unsigned int n_strains = 15;

    using Vector = Eigen::Matrix<double, n_strains, 1>;
    using Matrix = Eigen::Matrix<double, n_strains, n_strains>;

    /** Indices of the pair of vectors of each generalised strain. */
    static constexpr std::array<std::array<unsigned int, 2>, n_strains> pairs{
      {{{0, 0}},
       {{1, 1}},
       {{2, 2}},
       {{3, 3}},
       {{4, 4}},
       {{0, 1}},
       {{0, 2}},
       {{0, 3}},
       {{0, 4}},
       {{1, 2}},
       {{1, 3}},
       {{1, 4}},
       {{2, 3}},
       {{2, 4}},
       {{3, 4}}}};

    /** Straight reference, in closed form. */
    static Matrix
    straight(const double radius,
             const double young_modulus,
             const double poisson_ratio);

    /**
     * Curved reference with the vectors @p q = G1, G2, X0', G1', G2' (per unit
     * of the parameter in which strains are measured), integrated with a disc
     * rule. Throws InputError when the section reaches its centre of
     * curvature.
     */
    static Matrix
    curved(const std::array<Vector3, 5> &q,
           const double                  radius,
           const double                  young_modulus,
           const double                  poisson_ratio);
  };
} // namespace fiberloom

#endif
