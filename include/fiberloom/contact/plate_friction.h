// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_contact_plate_friction_h
#define fiberloom_contact_plate_friction_h

#include <fiberloom/contact/contact_law.h>

#include <Eigen/Core>

namespace fiberloom
{
  /**
   * Friction of a fiber's section on a horizontal plate that does not move
   * sideways: the law of section 2.7 of the theory for the material particle
   * that was the lowest or highest one of the section when the limit was set.
   */
  struct PlateFriction
  {
    /** A section: centre, r g1, r g2 [mm]. */
    using Section = Eigen::Matrix<double, 9, 1>;
    using Hessian = Eigen::Matrix<double, 9, 9>;

    double          limit               = 0; // mu f* [N]; 0: none
    double          normal_force_before = 0; // f* [N]
    double          elastic_slip        = 0; // [mm]
    Eigen::Vector3d particle; // weights of c, r g1, r g2 in its place
    Eigen::Vector2d origin;   // its place in the plane without slip [mm]

    /** The particle of a section that touches a plate. */
    enum class Extreme
    {
      lowest,
      highest
    };

    /** Takes the lowest or highest particle of @p section . */
    void
    place_particle(const Section &section, const Extreme extreme);

    /** Place of the particle in the plane [mm]. */
    Eigen::Vector2d
    place(const Section &section) const;

    /** Motion of the particle since it was at its origin [mm]. */
    Eigen::Vector2d
    slip(const Section &section) const
    {
      return place(section) - origin;
    }

    /** The part of the slip that would go back [mm]. */
    Eigen::Vector2d
    reversible_slip(const Section &section) const;

    /** Energy, force and its derivative by the slip, see friction_law(). */
    LawValue
    law(const Section &section) const
    {
      return friction_law(slip(section).norm(), limit, elastic_slip);
    }

    /** The part of the energy that is lost [N mm]. */
    double
    dissipated_energy(const Section &section) const;

    /**
     * Gradient of the energy by the nine components of @p section [N] and,
     * where @p hessian is not null, its Hessian, 9 x 9 [N/mm].
     */
    void
    evaluate(const Section &section, Section &gradient, Hessian *hessian) const;
  };
} // namespace fiberloom

#endif
