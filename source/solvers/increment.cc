// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/parameters.h>
#include <fiberloom/base/rounding.h>
#include <fiberloom/base/scoped_timer.h>

#include <fiberloom/solvers/increment.h>

#include <algorithm>

namespace fiberloom
{
  namespace
  {
    /** Of contacts sorted by fibers, the one at the same place or null: a
     * crossing may have slid, the stations of a line stay on the first fiber.
     */
    const ContactElement *
    find_same(const std::vector<ContactElement> &contacts,
              const FiberMesh                   &mesh,
              const ContactElement              &contact)
    {
      const ContactElement *nearest = nullptr;
      double distance = contact.following == ContactElement::Points::closest ?
                          .5 :
                          rounding; // in elements
      for (auto other = std::lower_bound(contacts.begin(),
                                         contacts.end(),
                                         contact.fibers,
                                         [](const auto &c, const auto &fibers) {
                                           return c.fibers < fibers;
                                         });
           other != contacts.end() && other->fibers == contact.fibers;
           ++other)
        if (const double away =
              mesh.distance(contact.fibers[0], other->u[0], contact.u[0]);
            other->following == contact.following && away < distance)
          {
            distance = away;
            nearest  = &*other;
          }
      return nearest;
    }

    void
    keep_friction(const ContactElement &from, ContactElement &to)
    {
      to.points              = from.points;
      to.first_nodes         = from.first_nodes;
      to.weights             = from.weights;
      to.particles           = from.particles;
      to.friction_limit      = from.friction_limit;
      to.normal_force_before = from.normal_force_before;
      to.friction_normal     = from.friction_normal;
      to.slip_before         = from.slip_before;
      to.separation_before   = from.separation_before;
    }
  } // namespace



  Increment::Increment(const FiberMesh        &mesh,
                       const SolverParameters &parameters,
                       ContactGenerator       &generator,
                       System                 &system,
                       StageStatistics        &statistics)
    : mesh(mesh)
    , system(system)
    , statistics(statistics)
    , parameters(parameters)
    , generator(generator)
  {}



  void
  Increment::generate(State &state, const Problem &problem)
  {
    find_contacts(state, problem);
    update_plates(state, problem);
    ScopedTimer timer(statistics.seconds.assembly);
    system.reinit(contacts);
  }



  void
  Increment::regenerate(State &state, const Problem &problem)
  {
    const std::vector<ContactElement> before = std::move(contacts);
    find_contacts(state, problem);
    ScopedTimer timer(statistics.seconds.assembly);
    if (problem.rule.points_follow)
      for (ContactElement &contact : contacts)
        if (const ContactElement *same =
              find_same(before, mesh.with_images(), contact))
          keep_friction(*same, contact);
    if (!problem.rule.points_follow)
      update_plates(state, problem);
    system.reinit(contacts);
  }



  void
  Increment::update_plates(const State &state, const Problem &problem)
  {
    system.plates().update(state,
                           problem.before.q,
                           problem.before.contact.plates);
  }



  void
  Increment::find_contacts(State &state, const Problem &problem)
  {
    ScopedTimer timer(statistics.seconds.detection);
    contacts = generator.generate(state.q,
                                  problem.before.q,
                                  problem.rule,
                                  state.contact);
    ++statistics.contact_updates;
  }



  void
  Increment::update_normals(const State &state, const Problem &problem)
  {
    ScopedTimer timer(statistics.seconds.detection);
    generator.update(
      contacts, state.q, problem.before.q, problem.rule, state.contact);
    update_plates(state, problem);
    ++statistics.normal_updates;
  }



  void
  Increment::assemble(const State &state, const Problem &problem)
  {
    ScopedTimer timer(statistics.seconds.assembly);
    system.assemble(state, problem.targets, contacts);
  }



  double
  Increment::measure(const State &state, const Problem &problem)
  {
    ScopedTimer timer(statistics.seconds.assembly);
    system.assemble_residual(state, problem.targets, contacts);
    return residual(problem);
  }



  double
  Increment::measure_anew(State &state, const Problem &problem)
  {
    find_contacts(state, problem);
    update_plates(state, problem);
    return measure(state, problem);
  }



  double
  Increment::residual(const Problem &problem) const
  {
    return system.residual_norm() / scale(problem);
  }



  double
  Increment::scale(const Problem &problem) const
  {
    // Where nothing is stressed, as after a rigid motion, only rounding is
    // left.
    const double floor =
      std::max({problem.least_scale,
                rounding * system.stiffness_scale() * mesh.smallest_radius(),
                system.rounding_force() / tolerance()});
    double largest = 0;
    for (const ContactElement &contact : contacts)
      largest = std::max(largest, contact.normal_force);
    if (largest == 0)
      largest = system.force_scale();
    return std::max(largest, floor);
  }



  double
  Increment::tolerance() const
  {
    for (const ContactElement &contact : contacts)
      if (contact.normal_force > 0)
        return parameters.contact_tolerance;
    return parameters.newton_tolerance;
  }
} // namespace fiberloom
