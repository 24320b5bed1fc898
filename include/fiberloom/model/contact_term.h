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

    /** Of those that @p sum takes. */
    void
    visit_couplings(const std::vector<ContactElement> &contacts,
                    const Assembly                    &sum,
                    const CouplingVisitor             &couple) const;

    /** Of those that @p sum takes; stores their forces. */
    void
    add(const State                 &state,
        std::vector<ContactElement> &contacts,
        Assembly                    &sum) const;

    /** Of the stiffness_added of @p contacts alone. */
    void
    add_stiffness(const State                       &state,
                  const std::vector<ContactElement> &contacts,
                  Assembly                          &sum) const;

    /** This rank's part of those that @p sum takes [N mm]. */
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

    /** Whose points stand still. */
    void
    add_fixed(const DofVector &q, ContactElement &contact, Assembly &sum) const;

    /** Whose points follow the fibers. */
    void
    add_following(const DofVector &q,
                  ContactElement  &contact,
                  PotentialGroup  &normal,
                  Assembly        &sum) const;

    /** What friction's limit, which follows the normal force, adds to products
     * of the tangent. */
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
