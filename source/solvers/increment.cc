// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/parameters.h>
#include <fiberloom/base/scoped_timer.h>

#include <fiberloom/solvers/increment.h>

#include <algorithm>

namespace fiberloom
{
  Increment::Increment(const FiberMesh        &mesh,
                       const SolverParameters &parameters,
                       ContactGenerator       &generator,
                       System                 &system,
                       StageStatistics        &statistics)
    : mesh(mesh)
    , parameters(parameters)
    , generator(generator)
    , system(system)
    , statistics(statistics)
  {}



  void
  Increment::generate(State &state, const Problem &problem)
  {
    {
      ScopedTimer timer(statistics.seconds.detection);
      contacts = generator.generate(state.q,
                                    problem.before.q,
                                    problem.rule,
                                    state.contact);
      ++statistics.contact_updates;
    }
    ScopedTimer timer(statistics.seconds.assembly);
    system.reinit(contacts);
  }



  void
  Increment::update_normals(const State &state, const Problem &problem)
  {
    ScopedTimer timer(statistics.seconds.detection);
    generator.update(
      contacts, state.q, problem.before.q, problem.rule, state.contact);
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
                1e-9 * system.stiffness_scale() * mesh.smallest_radius(),
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
