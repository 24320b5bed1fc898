// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/rounding.h>

#include <fiberloom/contact/contact_law.h>
#include <fiberloom/contact/contact_potential.h>

#include <fiberloom/solvers/contact_prediction.h>

#include <algorithm>
#include <cmath>

namespace fiberloom
{
  namespace
  {
    // Contacts that close are the first time as stiff as at a depth, over the
    // radius, of the largest penetration at standard accuracy, if they get deep
    // enough.
    constexpr double closed_depth = .02, least_depth = .005;

    /** Of a law that is as deep as @p depth and is to have a @p force , from
     * there to that; @p guess is beyond both [N/mm]. */
    double
    secant_stiffness(const ContactElement &contact,
                     const double          depth,
                     const double          guess,
                     const double          force)
    {
      const LawValue here = contact_normal_law(contact, depth);
      if (force <= 0)
        return depth > 0 ? here.force / depth : 0;
      double there = std::max(depth, guess), step;
      // The law is convex: from the second step on this comes from above.
      do
        {
          const LawValue law = contact_normal_law(contact, there);
          step               = (force - law.force) / law.derivative;
          there += step;
        }
      while (std::abs(step) > rounding * contact.radii[0]);
      return std::abs(there - depth) > rounding * contact.radii[0] ?
               (force - here.force) / (there - depth) :
               here.derivative;
    }
  } // namespace



  ContactPrediction::ContactPrediction(const FiberMesh &mesh,
                                       System          &system,
                                       Increment       &increment,
                                       const Problem   &problem,
                                       const Kind       kind)
    : mesh(mesh)
    , system(system)
    , increment(increment)
    , problem(problem)
    , kind(kind)
    , stiffness(increment.contacts.size(), -1)
  {}



  bool
  ContactPrediction::add_stiffness(const State &state,
                                   const State &ahead,
                                   const double least_energy)
  {
    const DofVector q      = mesh.with_images(ahead.q);
    const double    least  = increment.tolerance() * increment.scale(problem);
    double          stored = 0; // by contacts that take part
    bool            any    = false;
    for (unsigned int i = 0; i < increment.contacts.size(); ++i)
      {
        ContactElement &contact = increment.contacts[i];
        const bool      is_new  = stiffness[i] < 0;
        contact.stiffness_added = 0;
        if (contact.following == ContactElement::Points::fixed ||
            contact.lost || (kind == Kind::closing && !is_new))
          continue;
        ContactElement there  = contact;
        const double   energy = normal_energy(there, mesh.with_images(), q);
        if (there.lost || (is_new && contact.gap >= 0 && there.gap >= 0))
          continue;
        const double r     = std::min(contact.radii[0], contact.radii[1]);
        const double depth = std::max(0., -contact.gap);
        const auto   own   = contact_normal_law(contact, depth);
        const double model = is_new ? own.derivative : stiffness[i];
        const double force = own.force - model * (there.gap + depth);
        const bool   differs =
          std::abs(there.normal_force - std::max(0., force)) > least;
        double wanted = model;
        if (is_new &&
            (kind == Kind::closing ?
               there.gap < -least_depth * r &&
                 depth < std::min(least_depth * r, contact.regularization) :
               depth == 0 && differs))
          wanted = contact_normal_law(contact, closed_depth * r).derivative;
        else if (kind == Kind::all && differs)
          wanted = secant_stiffness(contact, depth, -there.gap, force);
        if (wanted == model)
          continue;
        contact.stiffness_added = wanted - model;
        stiffness[i]            = wanted;
        any                     = true;
        stored += energy;
      }
    any = any && stored >= least_energy;
    if (any)
      system.add_stiffness(state, increment.contacts);
    for (ContactElement &contact : increment.contacts)
      contact.stiffness_added = 0;
    return any;
  }
} // namespace fiberloom
