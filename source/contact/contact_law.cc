// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/contact/contact_law.h>

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
    /** Components of the normal along the section vectors, and their norm. */
    struct Support
    {
      double v1, v2, h;

      Support(const Vector3 &normal, const SectionPair &x, const unsigned int s)
        : v1(normal.dot(x.segment<3>(9 * s + 3)))
        , v2(normal.dot(x.segment<3>(9 * s + 6)))
        , h(std::hypot(v1, v2))
      {}
    };

    Vector3
    trial_slip(const ContactElement &contact, const SectionPair &x)
    {
      const Vector3 slip = contact.slip_before +
                           particle_separation(contact, x) -
                           contact.separation_before;
      return slip - contact.normal * contact.normal.dot(slip);
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
        Matrix3::Identity() - contact.normal * contact.normal.transpose();
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
           Support(contact.normal, x, 0).h - Support(contact.normal, x, 1).h +
           contact.offset;
  }



  double
  contact_energy(const ContactElement &contact, const SectionPair &x)
  {
    double energy = normal_law(-contact_gap(contact, x),
                               contact.stiffness,
                               contact.regularization)
                      .energy;
    if (contact.friction_limit > 0)
      energy += friction_law(trial_slip(contact, x).norm(),
                             contact.friction_limit,
                             contact.elastic_slip)
                  .energy;
    return energy;
  }



  bool
  evaluate_contact(ContactElement    &contact,
                   const SectionPair &x,
                   SectionPair       &residual,
                   SectionPair2      *tangent)
  {
    const Vector3 &N = contact.normal;
    contact.gap      = contact_gap(contact, x);
    const LawValue law =
      normal_law(-contact.gap, contact.stiffness, contact.regularization);
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
            const Support support(N, x, s);
            g.segment<3>(3 * s) << (s == 0 ? 1. : -1.), -support.v1 / support.h,
              -support.v2 / support.h;
            if (tangent != nullptr)
              {
                const double n1       = support.v1 / support.h,
                             n2       = support.v2 / support.h,
                             c        = law.force / support.h;
                const Matrix3      NN = c * N * N.transpose();
                const unsigned int k  = 9 * s + 3;
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
        const Support support(contact.normal, x, s);
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
