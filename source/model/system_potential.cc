// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/contact/contact_law.h>
#include <fiberloom/contact/contact_potential.h>

#include <fiberloom/model/system.h>

#include <deal.II/base/mpi.h>

namespace fiberloom
{
  double
  System::energy(const State                       &state,
                 const std::vector<ContactElement> &contacts) const
  {
    double energy = 0;
    for (unsigned int e = 0; e < mesh.n_elements(); ++e)
      if (numbering.local_block(mesh.first_node(e)) >= 0)
        energy +=
          mesh.visit_element(e, state.fibers, [&](const BeamElement &element) {
            return element.energy(mesh.element_dofs(state.q, e));
          });
    const DofVector q = mesh.with_images(state.q);
    for (const ContactElement &contact : contacts)
      if (numbering.local_block(original(contact.first_nodes[0])) >= 0)
        {
          const SectionPair x = section_pair(contact, q);
          if (contact.following == ContactElement::Points::fixed)
            energy += contact_energy(contact, x);
          else
            {
              ContactElement moved = contact;
              energy +=
                normal_energy(moved, seen, q) + friction_energy(contact, x);
            }
        }
    if (composite != nullptr)
      energy += matrix_energy(state);
    if (supports.plates)
      energy += plate_energy(state);
    return dealii::Utilities::MPI::sum(energy, numbering.communicator());
  }



  double
  System::matrix_energy(const State &state) const
  {
    const MatrixMesh     &matrix    = composite->matrix();
    const Eigen::VectorXd positions = composite->positions(state.q);
    double                energy    = 0;
    for (unsigned int c = 0; c < matrix.n_cells(); ++c)
      if (numbering.local_block(composite->first_node() +
                                matrix.nodes(c).front()) >= 0)
        energy += matrix.element(c).energy(matrix.cell_positions(positions, c));
    for (const JunctionElement &junction : composite->junctions())
      if (numbering.local_block(junction.fiber_nodes()[0]) >= 0)
        energy += junction.energy(state.q, positions);
    return energy;
  }



  double
  System::stored_energy(const State                       &state,
                        const std::vector<ContactElement> &contacts) const
  {
    double          stored = energy(state, contacts);
    const DofVector q      = mesh.with_images(state.q);
    for (const ContactElement &contact : contacts)
      stored -= dissipated_energy(contact, section_pair(contact, q));
    return stored - plate_dissipation(state);
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
