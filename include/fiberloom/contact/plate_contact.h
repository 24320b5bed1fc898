// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_contact_plate_contact_h
#define fiberloom_contact_plate_contact_h

#include <Eigen/Core>

namespace fiberloom
{
  /**
   * Normal contact of a fiber's section with one of two rigid horizontal
   * plates, the penalty of section 2.6 of the theory with the gap
   *   g = s (c_z - z) - h,  h^2 = (r g1_z)^2 + (r g2_z)^2,
   * where s = 1 for the lower plate, at z = m - d / 2, and s = -1 for the upper
   * one, at z = m + d / 2.
   */
  struct PlateContact
  {
    /** c_z, r g1_z, r g2_z; then the distance d of the plates and their middle
     * m [mm]. */
    using Heights = Eigen::Matrix<double, 5, 1>;
    using Hessian = Eigen::Matrix<double, 5, 5>;

    double stiffness; // times the length that the section stands for [N/mm]
    double regularization; // penetration up to which the law is quadratic [mm]
    bool   upper;

    /**
     * Distance of the section from the plate [mm], negative where it is in the
     * plate.
     */
    double
    gap(const Heights &x) const;

    /** Energy of the contact at the heights @p x [N mm]. */
    double
    energy(const Heights &x) const;

    /**
     * Gradient of the energy by the five heights [N] and, where @p hessian is
     * not null, its Hessian, 5 x 5 [N/mm]. False, with nothing set, where they
     * do not touch.
     */
    bool
    evaluate(const Heights &x, Heights &gradient, Hessian *hessian) const;
  };
} // namespace fiberloom

#endif
