// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/parameters.h>

#include <fiberloom/solvers/penetration.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <array>

namespace fiberloom
{
  namespace
  {
    // More than in proportion, since the force grows with the stiffness. And
    // stiffening costs iterations: where a zone is deeper than the largest
    // penetration, all take part that would be next, and do so before an
    // increment begins.
    constexpr double stiffening = 2;

    // Of a line penalty over Young's modulus: that of a fiber's own section.
    constexpr double stiffness_of_section = dealii::numbers::PI_4;

    // Fibers this much deeper in each other than they were, and deeper than the
    // search sees beyond their surfaces, have been thrown there.
    constexpr double thrown = 2;

    double
    depth(const ContactElement &contact)
    {
      return -contact.gap / std::min(contact.radii[0], contact.radii[1]);
    }
  } // namespace



  Penetration::Penetration(const FiberMesh         &mesh,
                           const ContactParameters &parameters,
                           const Motion            &motion)
    : mesh(mesh.with_images())
    , parameters(parameters)
    , motion(motion)
  {}



  double
  Penetration::largest(const std::vector<ContactElement> &contacts) const
  {
    double largest = 0;
    for (const ContactElement &contact : contacts)
      largest = std::max(largest, depth(contact));
    return largest;
  }



  double
  Penetration::avoidable(const std::vector<ContactElement> &contacts) const
  {
    double largest = 0;
    for (const ContactElement &contact : contacts)
      if (!is_imposed(contact))
        largest = std::max(largest, depth(contact));
    return largest;
  }



  void
  Penetration::remember(const std::vector<ContactElement> &contacts)
  {
    deepest = std::max(parameters.search_margin, thrown * avoidable(contacts));
  }



  bool
  Penetration::is_thrown(const std::vector<ContactElement> &contacts) const
  {
    return parameters.line_stiffness == 0 && avoidable(contacts) > deepest;
  }



  bool
  Penetration::needs_stiffening(
    const std::vector<ContactElement> &contacts) const
  {
    return parameters.line_stiffness == 0 &&
           avoidable(contacts) > parameters.largest_penetration;
  }



  bool
  Penetration::stiffen(const std::vector<ContactElement> &contacts,
                       std::vector<ContactZone>          &zones) const
  {
    if (parameters.line_stiffness > 0)
      return false;
    const double              target = parameters.largest_penetration;
    std::vector<unsigned int> first(zones.size() + 1, 0); // part of each zone
    for (unsigned int z = 0; z < zones.size(); ++z)
      first[z + 1] = first[z] + zones[z].stiffness.size();
    std::vector<double> depths(first.back(), 0.);
    for (const ContactElement &contact : contacts)
      if (!is_imposed(contact))
        {
          double &deepest = depths[first[contact.zone] + contact.part];
          deepest         = std::max(deepest, depth(contact));
        }

    bool changed = false;
    for (unsigned int z = 0; z < zones.size(); ++z)
      for (unsigned int part = 0; part < zones[z].stiffness.size(); ++part)
        if (const double deepest = depths[first[z] + part];
            stiffening * deepest > target)
          {
            zones[z].stiffness[part].second *= stiffening * deepest / target;
            changed = true;
          }
    return changed;
  }



  bool
  Penetration::is_imposed(const ContactElement &contact) const
  {
    const auto &lines = mesh.lines();
    if (motion.is_periodic() ||
        contact.stiffness < stiffness_of_section *
                              std::min(lines[contact.fibers[0]].young_modulus,
                                       lines[contact.fibers[1]].young_modulus))
      return false;
    std::array<int, 2> bodies{{-1, -1}};
    for (unsigned int s = 0; s < 2; ++s)
      for (unsigned int n = 0; n < 3; ++n)
        bodies[s] =
          std::max(bodies[s], motion.holding_body(contact.first_nodes[s] + n));
    return bodies[0] >= 0 && bodies[0] == bodies[1];
  }
} // namespace fiberloom
