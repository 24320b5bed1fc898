// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/contact/plate_friction.h>

#include <algorithm>
#include <cmath>

namespace fiberloom
{
  void
  PlateFriction::place_particle(const Section &section, const Extreme extreme)
  {
    const double s = extreme == Extreme::highest ? 1 : -1,
                 h = std::hypot(section[5], section[8]);
    particle << 1, h > 0 ? s * section[5] / h : 0,
      h > 0 ? s * section[8] / h : 0;
  }



  Eigen::Vector2d
  PlateFriction::place(const Section &section) const
  {
    return particle[0] * section.segment<2>(0) +
           particle[1] * section.segment<2>(3) +
           particle[2] * section.segment<2>(6);
  }



  Eigen::Vector2d
  PlateFriction::reversible_slip(const Section &section) const
  {
    const Eigen::Vector2d slip = this->slip(section);
    return slip / std::max(1., slip.norm() / elastic_slip);
  }



  double
  PlateFriction::dissipated_energy(const Section &section) const
  {
    return limit * std::max(0., slip(section).norm() - elastic_slip);
  }



  void
  PlateFriction::evaluate(const Section &section,
                          Section       &gradient,
                          Hessian       *hessian) const
  {
    const Eigen::Vector2d slip     = this->slip(section);
    const double          s        = slip.norm();
    const LawValue        law      = friction_law(s, limit, elastic_slip);
    const bool            has_slip = s > 1e-12 * elastic_slip;
    const double          secant   = has_slip ? law.force / s : law.derivative;
    gradient.setZero();
    for (unsigned int v = 0; v < 3; ++v)
      gradient.segment<2>(3 * v) = particle[v] * secant * slip;
    if (hessian == nullptr)
      return;
    Eigen::Matrix2d stiffness = secant * Eigen::Matrix2d::Identity();
    if (has_slip)
      stiffness +=
        (law.derivative - secant) / (s * s) * slip * slip.transpose();
    hessian->setZero();
    for (unsigned int v = 0; v < 3; ++v)
      for (unsigned int w = 0; w < 3; ++w)
        hessian->block<2, 2>(3 * v, 3 * w) =
          particle[v] * particle[w] * stiffness;
  }
} // namespace fiberloom
