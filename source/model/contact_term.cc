// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/contact/contact_law.h>
#include <fiberloom/contact/contact_potential.h>

#include <fiberloom/model/contact_term.h>
#include <fiberloom/model/element_groups.h>

#include <algorithm>

namespace fiberloom
{
  namespace
  {
    /** Of the contact's friction and, where its points follow, of the normal
     * contact; some may come twice. */
    void
    append_nodes(const FiberMesh           &mesh,
                 const ContactElement      &contact,
                 std::vector<unsigned int> &nodes)
    {
      for (unsigned int s = 0; s < 2; ++s)
        {
          for (unsigned int a = 0; a < 3; ++a)
            nodes.push_back(contact.first_nodes[s] + a);
          if (contact.following == ContactElement::Points::fixed)
            continue;
          const LineWeights weights(mesh.lines()[contact.fibers[s]],
                                    contact.u[s]);
          for (unsigned int a = 0; a < weights.n; ++a)
            nodes.push_back(weights.first_node + a);
        }
    }
  } // namespace



  ContactTerm::ContactTerm(const FiberMesh &mesh, const BlockLayout &layout)
    : mesh(mesh)
    , seen(mesh.with_images())
    , seen_nodes(mesh.images() ? mesh.images()->nodes :
                                 std::vector<NodeImage>())
    , layout(layout)
  {}



  void
  ContactTerm::visit_couplings(const std::vector<ContactElement> &contacts,
                               const Assembly                    &sum,
                               const CouplingVisitor             &couple) const
  {
    std::vector<unsigned int> blocks;
    for (const ContactElement &contact : contacts)
      {
        if (!is_taken(contact, sum))
          continue;
        blocks.clear();
        append_nodes(seen, contact, blocks);
        std::sort(blocks.begin(), blocks.end());
        blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
        couple(blocks);
      }
  }



  void
  ContactTerm::add(const State                 &state,
                   std::vector<ContactElement> &contacts,
                   Assembly                    &sum) const
  {
    const DofVector q = mesh.with_images(state.q);
    PotentialGroup  normal;
    for (ContactElement &contact : contacts)
      {
        if (!is_taken(contact, sum))
          continue;
        if (contact.following == ContactElement::Points::fixed)
          add_fixed(q, contact, sum);
        else
          add_following(q, contact, normal, sum);
      }
  }



  void
  ContactTerm::add_fixed(const DofVector &q,
                         ContactElement  &contact,
                         Assembly        &sum) const
  {
    ContactGroup group(contact);
    const bool   mine =
      sum.touches_owned(group.nodes.data(), group.n_nodes, seen_nodes);
    const bool active =
      evaluate_contact(contact,
                       section_pair(contact, q),
                       group.residual,
                       sum.with_tangent() && mine ? &group.tangent : nullptr);
    if (active && mine)
      sum.scatter(group, seen_nodes);
  }



  void
  ContactTerm::add_following(const DofVector &q,
                             ContactElement  &contact,
                             PotentialGroup  &normal,
                             Assembly        &sum) const
  {
    // All ranks need the forces, those that own one of its nodes the rest.
    normal.nodes.clear();
    append_nodes(seen, contact, normal.nodes);
    const bool mine =
      sum.touches_owned(normal.nodes.data(), normal.nodes.size(), seen_nodes);
    const bool with_tangent = sum.with_tangent() && mine;
    const bool active =
      evaluate_normal(contact,
                      seen,
                      q,
                      normal.potential,
                      with_tangent ? sum.curvature() : Curvature::none);
    if (active && mine)
      {
        normal.set_nodes();
        sum.scatter(normal, seen_nodes);
      }
    contact.friction_force = Vector3::Zero();
    contact.slip           = Vector3::Zero();
    if (!(contact.friction_limit > 0))
      return;
    ContactGroup friction(contact);
    evaluate_friction(contact,
                      section_pair(contact, q),
                      friction.residual,
                      with_tangent ? &friction.tangent : nullptr);
    if (mine)
      sum.scatter(friction, seen_nodes);
    if (with_tangent && active)
      couple_limit(contact, friction, normal, sum);
  }



  void
  ContactTerm::couple_limit(const ContactElement &contact,
                            const ContactGroup   &friction,
                            const PotentialGroup &normal,
                            Assembly             &sum) const
  {
    const unsigned int n = normal.nodes.size();
    const double       coefficient =
      contact.friction_limit / std::max(contact.normal_force_before, 1e-300);
    HeldGroup rows = sum.held_group(normal.nodes, seen_nodes), columns(rows);
    for (unsigned int a = 0; a < n; ++a)
      {
        Eigen::Matrix<double, 9, 1> force = Eigen::Matrix<double, 9, 1>::Zero();
        for (unsigned int b = 0; b < friction.n_nodes; ++b)
          if (friction.nodes[b] == normal.nodes[a] &&
              b / 3 == normal.potential.fiber[a])
            force = friction.force(b) / contact.friction_limit;
        rows.set_force(a, force);
        columns.set_force(a,
                          coefficient * normal.potential.value[a] *
                            normal.potential.force_slope.segment<9>(
                              9 * normal.potential.fiber[a]));
      }
    sum.add_product(rows, columns);
  }



  void
  ContactTerm::add_stiffness(const State                       &state,
                             const std::vector<ContactElement> &contacts,
                             Assembly                          &sum) const
  {
    const DofVector q = mesh.with_images(state.q);
    PotentialGroup  normal;
    for (const ContactElement &contact : contacts)
      {
        if (contact.stiffness_added == 0)
          continue;
        ContactElement predicted = contact;
        if (!evaluate_normal(
              predicted, seen, q, normal.potential, sum.curvature()))
          continue;
        normal.set_nodes();
        if (sum.touches_owned(normal.nodes.data(),
                              normal.nodes.size(),
                              seen_nodes))
          sum.scatter(normal, seen_nodes);
      }
  }



  double
  ContactTerm::energy(const State                       &state,
                      const std::vector<ContactElement> &contacts,
                      const Assembly                    &sum) const
  {
    const DofVector q      = mesh.with_images(state.q);
    double          energy = 0;
    for (const ContactElement &contact : contacts)
      if (layout.local_block(original(contact.first_nodes[0])) >= 0 &&
          is_taken(contact, sum))
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
    return energy;
  }
} // namespace fiberloom
