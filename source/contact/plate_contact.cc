// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/contact/contact_law.h>
#include <fiberloom/contact/plate_contact.h>

#include <cmath>

namespace fiberloom
{
  double
  PlateContact::gap(const Heights &x) const
  {
    const double s = upper ? -1 : 1;
    return s * (x[0] - x[4]) + .5 * x[3] - std::hypot(x[1], x[2]);
  }



  double
  PlateContact::energy(const Heights &x) const
  {
    return normal_law(-gap(x), stiffness, regularization).energy;
  }



  bool
  PlateContact::evaluate(const Heights &x,
                         Heights       &gradient,
                         Hessian       *hessian) const
  {
    const LawValue law = normal_law(-gap(x), stiffness, regularization);
    if (!(law.force > 0))
      return false;
    const double s = upper ? -1 : 1, h = std::hypot(x[1], x[2]);
    // A section that lies flat in the plate has no border towards it.
    const Eigen::Vector2d n =
      h > 0 ? Eigen::Vector2d(x.segment<2>(1) / h) : Eigen::Vector2d(0, 0);
    Heights slope;
    slope << s, -n, .5, -s;
    gradient = -law.force * slope;
    if (hessian != nullptr)
      {
        *hessian = law.derivative * slope * slope.transpose();
        if (h > 0)
          hessian->block<2, 2>(1, 1) +=
            law.force / h * (Eigen::Matrix2d::Identity() - n * n.transpose());
      }
    return true;
  }
} // namespace fiberloom
