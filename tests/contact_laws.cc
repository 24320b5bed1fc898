// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// The normal and the friction law, and the contact element: energy against
// force against derivative, the support function against the border of the
// section, forces that balance, and a fiber that may roll under its contact.

#include <fiberloom/contact/contact_law.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <fstream>

#include "checks.h"

using namespace fiberloom;

namespace
{
  template <class Law>
  void
  check_law(Checks            &checks,
            const std::string &name,
            const Law         &law,
            const double       end_of_quadratic_part)
  {
    double force = 0, derivative = 0;
    for (const double x : {.3, .7, 1.5, 4.})
      {
        const double at = x * end_of_quadratic_part, h = 1e-5;
        const auto   before = law(at - h), after = law(at + h);
        force      = std::max(force,
                         std::abs((after.energy - before.energy) / (2 * h) -
                                  law(at).force));
        derivative = std::max(derivative,
                              std::abs((after.force - before.force) / (2 * h) -
                                       law(at).derivative));
      }
    checks.below(name + ": force by differences", force, 1e-8);
    checks.below(name + ": derivative by differences", derivative, 1e-8);
    for (const double end : {0., end_of_quadratic_part})
      {
        const auto before = law(end * (1 - 1e-12) - 1e-14),
                   after  = law(end * (1 + 1e-12) + 1e-12);
        checks.below(name + ": jump at " + std::to_string(end),
                     std::abs(after.energy - before.energy) +
                       std::abs(after.force - before.force) +
                       std::abs(end > 0 ? after.derivative - before.derivative :
                                          0),
                     1e-10);
      }
  }

  void
  check_laws(Checks &checks)
  {
    check_law(
      checks,
      "normal law",
      [](const double p) { return normal_law(p, 3, .4); },
      .4);
    check_law(
      checks,
      "crossing law",
      [](const double p) { return crossing_law(p, 3, .4); },
      .4);
    checks.equal("crossing law without a quadratic part",
                 crossing_law(.3, 3, 0).force,
                 2 * std::pow(.3, 1.5));
    checks.equal("no force across a gap", normal_law(-.1, 3, .4).force, 0);
    checks.equal("the slope is the stiffness",
                 normal_law(2, 3, .4).derivative,
                 3);

    // Slip has no sign: the law is mirrored at 0.
    const auto friction = [](const double s) {
      LawValue law = friction_law(std::abs(s), 2, .5);
      if (s < 0)
        law.force = -law.force;
      return law;
    };
    check_law(checks, "friction law", friction, .5);
    checks.equal("the limit is reached", friction_law(.5, 2, .5).force, 2);
    checks.equal("and not passed", friction_law(50, 2, .5).force, 2);
  }

  /** Two sections, somewhat deformed, the first above the second. */
  SectionPair
  sample_sections()
  {
    SectionPair x;
    x << .1, -.2, 1.8, 0, .1, 1.02, .9, -.1, .2, -.1, .05, 0, .97, .2, .1, -.2,
      .1, -1.05;
    return x;
  }

  ContactElement
  sample_contact(const double penetration)
  {
    ContactElement contact;
    contact.normal          = Vector3(.1, -.15, 1).normalized();
    contact.friction_normal = contact.normal;
    contact.offset          = 0;
    contact.stiffness       = 1.5;
    contact.length          = 2;
    contact.spread          = 0;
    contact.skewness        = {{1, 1}};
    contact.regularization  = .02;
    contact.friction_limit  = 0;
    contact.elastic_slip    = .05;
    contact.slip_before.setZero();
    contact.separation_before.setZero();
    contact.radii     = {{1, 1}};
    contact.particles = {};

    // The requested penetration, whatever the sections.
    const SectionPair x = sample_sections();
    contact.offset      = -penetration - contact_gap(contact, x);
    place_particles(contact, x);
    return contact;
  }

  void
  check_element(Checks               &checks,
                const std::string    &name,
                const ContactElement &contact,
                const SectionPair    &x)
  {
    const auto force = [&](const SectionPair &y) {
      ContactElement copy     = contact;
      SectionPair    residual = SectionPair::Zero();
      evaluate_contact(copy, y, residual, nullptr);
      return residual;
    };
    const auto energy = [&](const SectionPair &y) {
      return contact_energy(contact, y);
    };
    ContactElement copy = contact;
    SectionPair    residual;
    SectionPair2   tangent;
    checks.that(name + ": active",
                evaluate_contact(copy, x, residual, &tangent));
    checks.below(name + ": residual",
                 relative_error(difference_gradient(energy, x, 1e-5), residual),
                 1e-6);
    checks.below(name + ": tangent",
                 relative_error(difference_jacobian(force, x, 1e-5), tangent),
                 1e-5);
    checks.below(name + ": residual alone",
                 relative_error(force(x), residual),
                 1e-12);
  }

  void
  check_elements(Checks &checks)
  {
    const SectionPair x = sample_sections();
    check_element(checks, "quadratic part", sample_contact(.01), x);
    check_element(checks, "linear part", sample_contact(.1), x);

    ContactElement skew = sample_contact(.1);
    skew.spread         = 1.5;
    skew.skewness       = {{1.01, 1.03}};
    skew.offset         = 0;
    skew.offset         = -.1 - contact_gap(skew, x);
    check_element(checks, "crossing", skew, x);

    ContactElement contact = sample_contact(.1);
    contact.friction_limit = .06;
    contact.slip_before    = Vector3(.01, .005, 0);
    contact.slip_before -=
      contact.normal * contact.normal.dot(contact.slip_before);
    contact.separation_before = particle_separation(contact, x);
    check_element(checks, "sticking", contact, x);

    ContactElement evaluated = contact;
    SectionPair    residual;
    evaluate_contact(evaluated, x, residual, nullptr);
    checks.that("status stick",
                evaluated.status == ContactElement::Status::stick);
    checks.below("slip kept",
                 (evaluated.slip - contact.slip_before).norm(),
                 1e-12);

    contact.separation_before += Vector3(.2, -.1, .05);
    check_element(checks, "slipping", contact, x);
    evaluate_contact(evaluated = contact, x, residual, nullptr);
    checks.that("status slip",
                evaluated.status == ContactElement::Status::slip);
    checks.equal("friction at its limit",
                 evaluated.friction_force.norm() / contact.friction_limit,
                 1);
    checks.below("friction across the normal",
                 evaluated.friction_force.dot(contact.normal),
                 1e-12);
    checks.that("friction against the slip",
                evaluated.friction_force.dot(evaluated.slip) < 0);
    checks.equal("slip cut at the elastic one",
                 evaluated.slip.norm() / contact.elastic_slip,
                 1);

    ContactElement open = sample_contact(-.1);
    checks.that("open contact is left out",
                !evaluate_contact(open, x, residual, nullptr) &&
                  open.status == ContactElement::Status::open &&
                  open.normal_force == 0);
    checks.equal("its gap", open.gap, .1);
  }

  /** Point of a section's border, z = (cos, sin). */
  Vector3
  border(const SectionPair &x, const unsigned int s, const double angle)
  {
    return x.segment<3>(9 * s) + std::cos(angle) * x.segment<3>(9 * s + 3) +
           std::sin(angle) * x.segment<3>(9 * s + 6);
  }

  void
  check_support(Checks &checks)
  {
    const SectionPair x       = sample_sections();
    ContactElement    contact = sample_contact(0);
    contact.offset            = .3;

    const unsigned int n      = 100000;
    double             lowest = 1e9, highest = -1e9;
    for (unsigned int i = 0; i < n; ++i)
      {
        const double angle = 2 * M_PI * i / n;
        lowest  = std::min(lowest, contact.normal.dot(border(x, 0, angle)));
        highest = std::max(highest, contact.normal.dot(border(x, 1, angle)));
      }
    checks.below("gap from the borders",
                 contact_gap(contact, x) - (lowest - highest + .3),
                 1e-8);
    const auto particle = [&](const unsigned int s) {
      const auto &z = contact.particles[s];
      return border(x, s, std::atan2(z[1], z[0]));
    };
    checks.below("first particle at the support",
                 contact.normal.dot(particle(0)) - lowest,
                 1e-8);
    checks.below("second particle at the support",
                 contact.normal.dot(particle(1)) - highest,
                 1e-8);
    checks.below(
      "separation of the particles",
      (particle_separation(contact, x) - particle(0) + particle(1)).norm(),
      1e-12);
  }

  /** Of the forces on a section: resultant and moment about the origin. */
  std::array<Vector3, 2>
  resultant(const SectionPair &x, const SectionPair &f, const unsigned int s)
  {
    std::array<Vector3, 2> sum{{f.segment<3>(9 * s), Vector3::Zero()}};
    for (unsigned int v = 0; v < 3; ++v)
      sum[1] += x.segment<3>(9 * s + 3 * v).cross(f.segment<3>(9 * s + 3 * v));
    return sum;
  }

  void
  check_balance(Checks &checks)
  {
    const SectionPair x       = sample_sections();
    ContactElement    contact = sample_contact(.1);
    SectionPair       residual;
    evaluate_contact(contact, x, residual, nullptr);
    const auto first  = resultant(x, residual, 0),
               second = resultant(x, residual, 1);
    checks.below("forces balance", (first[0] + second[0]).norm(), 1e-12);
    checks.below("the force is along the normal",
                 (first[0] + contact.normal_force * contact.normal).norm(),
                 1e-12);
    // Each force acts at its particle, so the moments balance as soon as
    // the particles face each other along the normal.
    checks.below("moments balance but for the particles' separation",
                 (first[1] + second[1] -
                  particle_separation(contact, x).cross(first[0]))
                   .norm(),
                 1e-12);

    SectionPair aligned = x;
    Vector3     apart   = particle_separation(contact, x);
    apart -= contact.normal * contact.normal.dot(apart);
    aligned.head<3>() -= apart;
    evaluate_contact(contact, aligned, residual, nullptr);
    checks.below("moments balance",
                 (resultant(aligned, residual, 0)[1] +
                  resultant(aligned, residual, 1)[1])
                   .norm(),
                 1e-12);
  }

  /** The first fiber turned about its own axis, that is along x. */
  SectionPair
  rolled(const SectionPair &x, const double angle)
  {
    const Eigen::AngleAxisd turn(angle, Vector3::UnitX());
    SectionPair             y = x;
    y.segment<3>(3)           = turn * x.segment<3>(3);
    y.segment<3>(6)           = turn * x.segment<3>(6);
    return y;
  }

  /**
   * Particles that stay where they were placed rise from the contact when the
   * fiber rolls: the contact then pushes it on, with stiffness -F r.
   */
  void
  check_rolling(Checks &checks)
  {
    SectionPair x;
    x << 0, 0, 1.9, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1;
    ContactElement contact  = sample_contact(.1);
    contact.normal          = Vector3::UnitZ();
    contact.friction_normal = contact.normal;
    contact.offset          = 0;
    place_particles(contact, x);

    double       change = 0;
    const double angle  = .2;
    for (unsigned int i = 1; i < 30; ++i)
      change = std::max(change,
                        std::abs(contact_gap(contact, rolled(x, i * angle)) -
                                 contact_gap(contact, x)));
    checks.below("gap of a rolling fiber", change, 1e-12);
    const double frozen =
      contact.normal.dot(particle_separation(contact, rolled(x, angle)) -
                         particle_separation(contact, x));
    checks.equal("gap of a frozen particle over the radius",
                 frozen,
                 1 - std::cos(angle));

    // Along the curve of rolling the energy has neither slope nor curvature.
    SectionPair  residual;
    SectionPair2 tangent;
    evaluate_contact(contact, x, residual, &tangent);
    SectionPair velocity = SectionPair::Zero(), acceleration = velocity;
    velocity.segment<3>(3)     = Vector3::UnitX().cross(x.segment<3>(3));
    velocity.segment<3>(6)     = Vector3::UnitX().cross(x.segment<3>(6));
    acceleration.segment<6>(3) = -x.segment<6>(3);
    checks.below("moment against rolling", residual.dot(velocity), 1e-12);
    checks.below("stiffness against rolling",
                 velocity.dot(tangent * velocity) + residual.dot(acceleration),
                 1e-12);
    checks.above(
      "smallest eigenvalue",
      Eigen::SelfAdjointEigenSolver<SectionPair2>(tangent).eigenvalues()[0],
      -1e-12);
  }
} // namespace

int
main()
{
  std::ofstream output("output");
  Checks        checks(output);
  check_laws(checks);
  check_elements(checks);
  check_support(checks);
  check_balance(checks);
  check_rolling(checks);
}
