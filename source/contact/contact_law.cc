// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/contact/contact_law.h>

#include <algorithm>
#include <cmath>

namespace fiberloom
{
  LawValue
  normal_law(const double penetration,
             const double stiffness,
             const double regularization)
  {
    const double p = penetration, p0 = regularization;
    if (p <= 0)
      return {0, 0, 0};
    if (p < p0)
      return {stiffness * p * p * p / (6 * p0),
              stiffness * p * p / (2 * p0),
              stiffness * p / p0};
    return {stiffness * (p * (p - p0) / 2 + p0 * p0 / 6),
            stiffness * (p - p0 / 2),
            stiffness};
  }



  LawValue
  crossing_law(const double penetration,
               const double stiffness,
               const double regularization)
  {
    const double p = penetration, p0 = regularization;
    if (p <= 0)
      return {0, 0, 0};
    const double k = stiffness * std::sqrt(p);

    // Over t = x / sqrt(2 D p) the overlap is p (1 - t^2): integrals over the
    // inner part, where the law is linear, and the outer one.
    const double t  = (p > p0) ? std::sqrt(1 - p0 / p) : 0;
    const double t3 = t * t * t, t5 = t3 * t * t, t7 = t5 * t * t;
    const double first  = t - t3 / 3;              // of 1 - t^2
    const double second = t - 2 * t3 / 3 + t5 / 5; // of (1 - t^2)^2
    const double third  = t - t3 + 3 * t5 / 5 - t7 / 7;
    LawValue     value{p * (p * second - p0 * first) / 2 + p0 * p0 / 6 * t,
                   p * first - p0 / 2 * t,
                   t};
    if (p0 > 0)
      {
        value.energy += p * p * p / (6 * p0) * (16. / 35 - third);
        value.force += p * p / (2 * p0) * (8. / 15 - second);
        value.derivative += p / p0 * (2. / 3 - first);
      }
    return {k * value.energy, k * value.force, k * value.derivative};
  }



  LawValue
  acute_cosine(const double cosine)
  {
    constexpr double right = .2, nearly_one = 1 - 1e-12;
    const double     sign = cosine < 0 ? -1 : 1, c = std::abs(cosine);
    if (c >= right)
      return {std::min(c, nearly_one), sign, 0};
    const double s = c / right;
    return {right * s * s * (3 - s * (3 - s)),
            sign * s * (6 - s * (9 - 4 * s)),
            (6 - s * (18 - 12 * s)) / right};
  }



  double
  crossing_spread(const double cosine, const std::array<double, 2> &radii)
  {
    const double c = acute_cosine(cosine).energy;
    return std::sqrt((1 + c) / (1 - c) * 2 * (radii[0] + radii[1]));
  }



  LawValue
  contact_normal_law(const ContactElement &contact, const double penetration)
  {
    return contact.spread > 0 ? crossing_law(penetration,
                                             contact.stiffness * contact.spread,
                                             contact.regularization) :
                                normal_law(penetration,
                                           contact.stiffness * contact.length,
                                           contact.regularization);
  }



  LawValue
  friction_law(const double slip, const double limit, const double elastic_slip)
  {
    const double s = slip / elastic_slip;
    if (s < 1)
      return {limit * elastic_slip * s * s * (1 - s / 3),
              limit * s * (2 - s),
              limit / elastic_slip * 2 * (1 - s)};
    return {limit * elastic_slip * (s - 1. / 3), limit, 0};
  }



  SectionPair
  section_pair(const ContactElement &contact, const DofVector &q)
  {
    SectionPair x = SectionPair::Zero();
    for (unsigned int s = 0; s < 2; ++s)
      for (unsigned int a = 0; a < 3; ++a)
        x.segment<9>(9 * s) += contact.weights[s][a] *
                               q.segment<9>(9 * (contact.first_nodes[s] + a));
    return x;
  }



  namespace
  {
    /**
     * Components of the normal along the section vectors, and their norm, the
     * distance of the section's border from its centre.
     */
    struct Support
    {
      double v1, v2, h;

      Support(const ContactElement &contact,
              const SectionPair    &x,
              const unsigned int    s)
        : v1(contact.skewness[s] * contact.normal.dot(x.segment<3>(9 * s + 3)))
        , v2(contact.skewness[s] * contact.normal.dot(x.segment<3>(9 * s + 6)))
        , h(std::hypot(v1, v2))
      {}
    };

    Vector3
    trial_slip(const ContactElement &contact, const SectionPair &x)
    {
      const Vector3 slip = contact.slip_before +
                           particle_separation(contact, x) -
                           contact.separation_before;
      return slip - contact.friction_normal * contact.friction_normal.dot(slip);
    }

    void
    add_friction(ContactElement    &contact,
                 const SectionPair &x,
                 SectionPair       &residual,
                 SectionPair2      *tangent)
    {
      const Vector3  slip = trial_slip(contact, x);
      const double   s    = slip.norm();
      const LawValue law =
        friction_law(s, contact.friction_limit, contact.elastic_slip);
      const double  secant = (s > 1e-12 * contact.elastic_slip) ?
                               law.force / s :
                               2 * contact.friction_limit / contact.elastic_slip;
      const Vector3 force  = secant * slip;

      contact.friction_force = -force;
      contact.slip           = (s > contact.elastic_slip) ?
                                 Vector3(slip * (contact.elastic_slip / s)) :
                                 slip;
      contact.status         = (s > contact.elastic_slip) ?
                                 ContactElement::Status::slip :
                                 ContactElement::Status::stick;

      // Weight of each of the six section vectors in the separation.
      const std::array<double, 6> weight{{1,
                                          contact.particles[0][0],
                                          contact.particles[0][1],
                                          -1,
                                          -contact.particles[1][0],
                                          -contact.particles[1][1]}};
      for (unsigned int i = 0; i < 6; ++i)
        residual.segment<3>(3 * i) += weight[i] * force;

      if (tangent == nullptr)
        return;
      const Matrix3 projection =
        Matrix3::Identity() -
        contact.friction_normal * contact.friction_normal.transpose();
      Matrix3 stiffness = secant * projection;
      if (s > 1e-12 * contact.elastic_slip)
        stiffness +=
          (law.derivative - secant) / (s * s) * slip * slip.transpose();
      for (unsigned int i = 0; i < 6; ++i)
        for (unsigned int j = 0; j < 6; ++j)
          tangent->block<3, 3>(3 * i, 3 * j) +=
            weight[i] * weight[j] * stiffness;
    }
  } // namespace



  double
  contact_gap(const ContactElement &contact, const SectionPair &x)
  {
    return contact.normal.dot(x.head<3>() - x.segment<3>(9)) -
           Support(contact, x, 0).h - Support(contact, x, 1).h + contact.offset;
  }



  double
  friction_energy(const ContactElement &contact, const SectionPair &x)
  {
    if (!(contact.friction_limit > 0))
      return 0;
    return friction_law(trial_slip(contact, x).norm(),
                        contact.friction_limit,
                        contact.elastic_slip)
      .energy;
  }



  double
  contact_energy(const ContactElement &contact, const SectionPair &x)
  {
    return contact_normal_law(contact, -contact_gap(contact, x)).energy +
           friction_energy(contact, x);
  }



  void
  evaluate_friction(ContactElement    &contact,
                    const SectionPair &x,
                    SectionPair       &residual,
                    SectionPair2      *tangent)
  {
    residual.setZero();
    if (tangent != nullptr)
      tangent->setZero();
    add_friction(contact, x, residual, tangent);
  }



  double
  dissipated_energy(const ContactElement &contact, const SectionPair &x)
  {
    if (!(contact.friction_limit > 0))
      return 0;
    const double slip = trial_slip(contact, x).norm();
    return contact.friction_limit * std::max(0., slip - contact.elastic_slip);
  }



  bool
  evaluate_contact(ContactElement    &contact,
                   const SectionPair &x,
                   SectionPair       &residual,
                   SectionPair2      *tangent)
  {
    const Vector3 &N       = contact.normal;
    contact.gap            = contact_gap(contact, x);
    const LawValue law     = contact_normal_law(contact, -contact.gap);
    contact.normal_force   = law.force;
    contact.friction_force = Vector3::Zero();
    contact.slip           = Vector3::Zero();
    contact.status         = law.force > 0 ? ContactElement::Status::stick :
                                             ContactElement::Status::open;
    if (!(law.force > 0) && !(contact.friction_limit > 0))
      return false;

    residual.setZero();
    if (tangent != nullptr)
      tangent->setZero();

    if (law.force > 0)
      {
        // The gap's derivative: each section vector gets a multiple of N.
        Eigen::Matrix<double, 6, 1> g;
        for (unsigned int s = 0; s < 2; ++s)
          {
            const Support support(contact, x, s);
            const double  skewness = contact.skewness[s];
            const double  n1       = support.v1 / support.h,
                         n2        = support.v2 / support.h;
            g.segment<3>(3 * s) << (s == 0 ? 1. : -1.), -skewness * n1,
              -skewness * n2;
            if (tangent != nullptr)
              {
                const double  c  = law.force * skewness * skewness / support.h;
                const Matrix3 NN = c * N * N.transpose();
                const unsigned int k = 9 * s + 3;
                tangent->block<3, 3>(k, k) += n2 * n2 * NN;
                tangent->block<3, 3>(k, k + 3) -= n1 * n2 * NN;
                tangent->block<3, 3>(k + 3, k) -= n1 * n2 * NN;
                tangent->block<3, 3>(k + 3, k + 3) += n1 * n1 * NN;
              }
          }
        for (unsigned int i = 0; i < 6; ++i)
          residual.segment<3>(3 * i) -= law.force * g[i] * N;
        if (tangent != nullptr)
          {
            const Matrix3 NN = law.derivative * N * N.transpose();
            for (unsigned int i = 0; i < 6; ++i)
              for (unsigned int j = 0; j < 6; ++j)
                tangent->block<3, 3>(3 * i, 3 * j) += g[i] * g[j] * NN;
          }
      }

    if (contact.friction_limit > 0)
      add_friction(contact, x, residual, tangent);
    return true;
  }



  void
  place_particles(ContactElement &contact, const SectionPair &x)
  {
    for (unsigned int s = 0; s < 2; ++s)
      {
        const Support support(contact, x, s);
        const double  sign   = (s == 0) ? -1 : 1;
        contact.particles[s] = {
          {sign * support.v1 / support.h, sign * support.v2 / support.h}};
      }
  }



  Vector3
  particle_separation(const ContactElement &contact, const SectionPair &x)
  {
    const auto position = [&](const unsigned int s) -> Vector3 {
      return x.segment<3>(9 * s) +
             contact.particles[s][0] * x.segment<3>(9 * s + 3) +
             contact.particles[s][1] * x.segment<3>(9 * s + 6);
    };
    return position(0) - position(1);
  }
} // namespace fiberloom
