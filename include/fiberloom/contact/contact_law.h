// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_contact_contact_law_h
#define fiberloom_contact_contact_law_h

#include <fiberloom/contact/contact_element.h>

namespace fiberloom
{
  /**
   * Energy [N mm], force [N] and its derivative [N/mm] of a one-dimensional law
   * of a length [mm].
   */
  struct LawValue
  {
    double energy;
    double force;
    double derivative;
  };

  /**
   * Penalty law of figure 7 of the paper, section 2.6 of the theory: the force
   * is stiffness * p^2 / (2 p0) for a @p penetration p [mm] up to
   * @p regularization p0 [mm], and linear with the slope @p stiffness [N/mm]
   * beyond; p0 = 0 makes it linear from the start. Without penetration all is
   * zero.
   */
  LawValue
  normal_law(const double penetration,
             const double stiffness,
             const double regularization);

  /**
   * The same law, as a force per length, integrated over the length on which
   * two crossing fibers overlap, given the @p penetration p where they are
   * closest [mm]. At an offset x across the fibers the overlap is p - x^2 / 2D,
   * so that with the @p stiffness [N/mm^(3/2)], which is the stiffness per
   * length times crossing_spread(), the linear law gives the force stiffness
   * 2/3 p^(3/2). Section 2.6 of the theory.
   */
  LawValue
  crossing_law(const double penetration,
               const double stiffness,
               const double regularization);

  /**
   * Absolute value of @p cosine , rounded off below 0.2 so that it is twice
   * continuous, with its first two derivatives in place of force and
   * derivative. At most just below 1.
   */
  LawValue
  acute_cosine(const double cosine);

  /**
   * Length of contact over the square root of the penetration [mm^(1/2)] of
   * two fibers at the angle a = acos( @p cosine ), whose @p radii add up to D:
   * cot(a/2) sqrt(2 D), with the cosine's absolute value rounded off below
   * twelve degrees from a right angle.
   */
  double
  crossing_spread(const double cosine, const std::array<double, 2> &radii);

  /**
   * The law that acts in @p contact : crossing_law() where it has a spread,
   * else normal_law() with its stiffness times its length. @p penetration :
   * [mm].
   */
  LawValue
  contact_normal_law(const ContactElement &contact, const double penetration);

  /**
   * Coulomb's law with a reversible elastic slip, figure 7 of the paper,
   * section 2.7 of the theory: the force @p limit phi(s) [N] with phi = 2s -
   * s^2 up to s = slip / elastic_slip = 1, the limit beyond. @p slip and
   * @p elastic_slip : [mm]. It has a potential as long as the limit is given.
   */
  LawValue
  friction_law(const double slip,
               const double limit,
               const double elastic_slip);

  /**
   * The 18 dofs of the two sections of a contact element: centre, r g1, r g2 of
   * the first, then of the second [mm]; also a gradient by them [N].
   */
  using SectionPair = Eigen::Matrix<double, 18, 1>;
  /** A Hessian by the dofs of a SectionPair, 18 x 18 [N/mm]. */
  using SectionPair2 = Eigen::Matrix<double, 18, 18>;

  /**
   * The sections of @p contact where the dofs of all fibers are @p q , by the
   * weights of the three nodes of each.
   */
  SectionPair
  section_pair(const ContactElement &contact, const DofVector &q);

  /**
   * Gap along the normal [mm], equation [5] of the paper, section 2.5 of the
   * theory: N.(c1 - c2) - s1 h1 - s2 h2 + offset, where h = sqrt((N.r g1)^2 +
   * (N.r g2)^2) is the support function of the section and the skewness s
   * accounts for a normal that is not across the fiber. The particle in contact
   * is where the support is attained, for any placement of the section; one
   * frozen between updates lets the loop on normals diverge, because fibers
   * roll.
   */
  double
  contact_gap(const ContactElement &contact, const SectionPair &x);

  /**
   * Energy of normal contact and of friction of @p contact where its sections
   * are @p x [N mm].
   */
  double
  contact_energy(const ContactElement &contact, const SectionPair &x);

  /**
   * The part of contact_energy() that is lost since the slip goes beyond the
   * reversible one [N mm]: the friction limit times the slip beyond.
   */
  double
  dissipated_energy(const ContactElement &contact, const SectionPair &x);

  /**
   * Gradient @p residual [N] and, if @p tangent is not null, Hessian [N/mm] of
   * contact_energy() by the 18 dofs @p x of the sections, with the normal and
   * the friction limit as they are. Stores gap, forces, slip and status in
   * @p contact . Returns false, with nothing else set than those, where the
   * contact is open and has no friction.
   */
  bool
  evaluate_contact(ContactElement    &contact,
                   const SectionPair &x,
                   SectionPair       &residual,
                   SectionPair2      *tangent);

  /**
   * The part of contact_energy() that friction stores and loses [N mm]; 0
   * without a friction limit.
   */
  double
  friction_energy(const ContactElement &contact, const SectionPair &x);

  /**
   * Gradient @p residual [N] and, if @p tangent is not null, Hessian [N/mm] of
   * friction_energy(). Stores friction force, slip and status in @p contact .
   */
  void
  evaluate_friction(ContactElement    &contact,
                    const SectionPair &x,
                    SectionPair       &residual,
                    SectionPair2      *tangent);

  /**
   * Places the particles of @p contact where the supports of its sections @p x
   * along the normal are attained.
   */
  void
  place_particles(ContactElement &contact, const SectionPair &x);

  /**
   * Position of the first particle of @p contact less that of the second [mm].
   */
  Vector3
  particle_separation(const ContactElement &contact, const SectionPair &x);
} // namespace fiberloom

#endif
