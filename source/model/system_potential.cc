// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/contact/contact_law.h>

#include <fiberloom/model/system.h>

#include <deal.II/base/mpi.h>

namespace fiberloom
{
  double
  System::energy(const State                       &state,
                 const std::vector<ContactElement> &contacts) const
  {
    double energy = contact_term.energy(state, contacts, sum);
    for (const auto &term : terms)
      energy += term->energy(state);
    return dealii::Utilities::MPI::sum(energy, numbering.communicator());
  }



  double
  System::stored_energy(const State                       &state,
                        const std::vector<ContactElement> &contacts) const
  {
    double          stored = energy(state, contacts);
    const DofVector q      = mesh.with_images(state.q);
    for (const ContactElement &contact : contacts)
      stored -= dissipated_energy(contact, section_pair(contact, q));
    return stored - dissipation(state);
  }



  double
  System::dissipation(const State &state) const
  {
    double dissipation = 0;
    for (const auto &term : terms)
      dissipation += term->dissipation(state);
    return dissipation;
  }



  double
  System::load_work(const Targets &targets,
                    const State   &before,
                    const State   &after) const
  {
    double work = 0;
    for (unsigned int b = 0; b < targets.bodies.size(); ++b)
      {
        const Placement &from = before.placements[b], &to = after.placements[b];
        BodyVector       motion;
        motion << to.position - from.position, to.turn - from.turn;
        work += targets.bodies[b].load.dot(motion);
      }
    for (unsigned int n = 0; n < targets.node_forces.size(); ++n)
      work += targets.node_forces[n].dot(after.q.segment<3>(9 * n) -
                                         before.q.segment<3>(9 * n));
    return work;
  }



  bool
  System::has_potential(const Targets &targets) const
  {
    for (unsigned int b = 0; b < targets.bodies.size(); ++b)
      {
        const auto        &prescribed = supports.bodies[b].prescribed;
        const unsigned int n_axes =
          !prescribed[3] + !prescribed[4] + !prescribed[5];
        if (n_axes > 1 && !targets.bodies[b].load.tail<3>().isZero(0))
          return false;
      }
    return true;
  }
} // namespace fiberloom
