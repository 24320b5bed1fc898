// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_model_contact_term_h
#define fiberloom_model_contact_term_h

#include <fiberloom/contact/contact_element.h>

#include <fiberloom/model/term.h>

#include <vector>

namespace fiberloom
{
  struct ContactGroup;
  struct PotentialGroup;

  /** Contacts and their friction: as Term, but contacts come and go. */
  class ContactTerm
  {
  public:
    /** Arguments are kept by reference. */
    ContactTerm(const FiberMesh &mesh, const BlockLayout &layout);

    /**
     * Calls @p couple with the blocks of each of the @p contacts that @p sum
     * takes.
     */
    void
    visit_couplings(const std::vector<ContactElement> &contacts,
                    const Assembly                    &sum,
                    const CouplingVisitor             &couple) const;

    /**
     * Adds residual and tangent of those @p contacts that @p sum takes, and
     * stores their forces.
     */
    void
    add(const State                 &state,
        std::vector<ContactElement> &contacts,
        Assembly                    &sum) const;

    /**
     * Adds the stiffness_added of @p contacts alone to the tangent of @p sum ,
     * and the force that open ones get by it.
     */
    void
    add_stiffness(const State                       &state,
                  const std::vector<ContactElement> &contacts,
                  Assembly                          &sum) const;

    /**
     * This rank's part of the energy of those @p contacts that @p sum takes
     * [N mm].
     */
    double
    energy(const State                       &state,
           const std::vector<ContactElement> &contacts,
           const Assembly                    &sum) const;

    /** What nodes that contact sees are images of; empty where it sees those of
     * the mesh. */
    const std::vector<NodeImage> &
    images() const
    {
      return seen_nodes;
    }

  private:
    /** What contact calls @p node. */
    unsigned int
    original(const unsigned int node) const
    {
      return seen_nodes.empty() ? node : seen_nodes[node].node;
    }

    /** Whether one of the fibers is among those that @p sum takes. */
    bool
    is_taken(const ContactElement &contact, const Assembly &sum) const
    {
      return sum.takes(original(contact.first_nodes[0])) ||
             sum.takes(original(contact.first_nodes[1]));
    }

    /** Adds a contact whose points stand still. */
    void
    add_fixed(const DofVector &q, ContactElement &contact, Assembly &sum) const;

    /** Adds a contact whose points follow the fibers. */
    void
    add_following(const DofVector &q,
                  ContactElement  &contact,
                  PotentialGroup  &normal,
                  Assembly        &sum) const;

    /**
     * Adds to products of the tangent how friction's limit follows the normal
     * force.
     */
    void
    couple_limit(const ContactElement &contact,
                 const ContactGroup   &friction,
                 const PotentialGroup &normal,
                 Assembly             &sum) const;

    const FiberMesh             &mesh;
    const FiberMesh             &seen; // by contact
    const std::vector<NodeImage> seen_nodes;
    const BlockLayout           &layout;
  };
} // namespace fiberloom

#endif
