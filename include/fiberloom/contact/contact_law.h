// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_contact_contact_law_h
#define fiberloom_contact_contact_law_h

#include <fiberloom/contact/contact_element.h>

namespace fiberloom
{
  /** Energy [N mm], force [N] and its derivative [N/mm] of a one-dimensional
   * law. */
  struct LawValue
  {
    double energy;
    double force;
    double derivative;
  };

  /**
   * Penalty law of figure 7 of the paper: linear with slope @p stiffness ,
   * quadratic up to the penetration @p regularization , 0 for a linear law.
   */
  LawValue
  normal_law(const double penetration,
             const double stiffness,
             const double regularization);

  /**
   * That law, as a force per length, over the length on which two crossing
   * fibers overlap, given the penetration p where they are closest. At an
   * offset x across the fibers the overlap is p - x^2 / 2D, so that with the
   * @p stiffness [N/mm^(3/2)], which is that per length times
   * crossing_spread(), the linear law gives stiffness 2/3 p^(3/2).
   */
  LawValue
  crossing_law(const double penetration,
               const double stiffness,
               const double regularization);

  /** Absolute value of a cosine, twice continuous, with two derivatives. */
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

  /** Whichever of the two acts in @p contact . */
  LawValue
  contact_normal_law(const ContactElement &contact, const double penetration);

  /**
   * Coulomb's law with a reversible elastic slip, figure 7 of the paper: the
   * force limit phi(s) with phi = 2s - s^2 up to s = slip / elastic_slip = 1,
   * the limit beyond. It has a potential as long as the limit is given.
   */
  LawValue
  friction_law(const double slip,
               const double limit,
               const double elastic_slip);

  /**
   * Dofs of the two sections of a contact element: centre, r g1, r g2 of the
   * first, then of the second [mm].
   */
  using SectionPair  = Eigen::Matrix<double, 18, 1>;
  using SectionPair2 = Eigen::Matrix<double, 18, 18>;

  /** The sections of @p contact at placement @p q . */
  SectionPair
  section_pair(const ContactElement &contact, const DofVector &q);

  /**
   * Gap along the normal: N.(c1 - c2) - s1 h1 - s2 h2 + offset, where
   * h = sqrt((N.r g1)^2 + (N.r g2)^2) is the support function of the section
   * and the skewness s accounts for a normal that is not across the fiber.
   * The particle in contact is where the support is attained, for any
   * placement of the section; one frozen between updates lets the loop on
   * normals diverge, because fibers roll.
   */
  double
  contact_gap(const ContactElement &contact, const SectionPair &x);

  double
  contact_energy(const ContactElement &contact, const SectionPair &x);

  /** The part of it that is lost, as the reversible slip is exceeded. */
  double
  dissipated_energy(const ContactElement &contact, const SectionPair &x);

  /**
   * Gradient and, if @p tangent is given, Hessian of the energy; stores gap,
   * forces, slip and status in @p contact . Returns false, with nothing else
   * set than those, when the contact is open.
   */
  bool
  evaluate_contact(ContactElement    &contact,
                   const SectionPair &x,
                   SectionPair       &residual,
                   SectionPair2      *tangent);

  /** The part of the energy that friction stores and loses. */
  double
  friction_energy(const ContactElement &contact, const SectionPair &x);

  /** As evaluate_contact(), friction alone. */
  void
  evaluate_friction(ContactElement    &contact,
                    const SectionPair &x,
                    SectionPair       &residual,
                    SectionPair2      *tangent);

  /** Places the particles where the sections' supports are attained. */
  void
  place_particles(ContactElement &contact, const SectionPair &x);

  /** Separation of the two particles [mm]. */
  Vector3
  particle_separation(const ContactElement &contact, const SectionPair &x);
} // namespace fiberloom

#endif
