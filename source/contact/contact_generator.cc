// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/parameters.h>

#include <fiberloom/fabric/superimposition.h>

#include <fiberloom/contact/contact_exchange.h>
#include <fiberloom/contact/contact_generator.h>
#include <fiberloom/contact/contact_law.h>
#include <fiberloom/contact/contact_potential.h>
#include <fiberloom/contact/passage.h>
#include <fiberloom/contact/zone_class.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace fiberloom
{
  namespace
  {
    // Of axes, over the radius, for a normal along what lies between them.
    constexpr double least_distance = .01;

    std::vector<std::array<unsigned int, 2>>
    find_woven_pairs(const FiberSet &set, const FiberImages *images)
    {
      std::vector<std::array<unsigned int, 2>> pairs;
      for (unsigned int i = 0; set.pattern && i < set.fibers.size(); ++i)
        for (unsigned int j = i + 1; j < set.fibers.size(); ++j)
          if (superimposition(set, i, j) != 0 &&
              set.tows[set.fibers[i].tow].ply ==
                set.tows[set.fibers[j].tow].ply &&
              (images == nullptr || images->is_pair(i, j)))
            pairs.push_back({{i, j}});
      return pairs;
    }

    double
    largest_stiffness(const ContactZone &zone)
    {
      double largest = 0;
      for (const auto &part : zone.stiffness)
        largest = std::max(largest, part.second);
      return largest;
    }

    int
    sign(const double value)
    {
      return value >= 0 ? 1 : -1;
    }
  } // namespace



  ContactGenerator::ContactGenerator(const FiberSet          &fibers,
                                     const FiberMesh         &mesh,
                                     const ContactParameters &parameters,
                                     const MPI_Comm           comm)
    : cell(mesh)
    , fibers(mesh.images() ? mesh.images()->fibers : fibers)
    , mesh(mesh.with_images())
    , parameters(parameters)
    , comm(comm)
    , search(mesh.with_images(),
             parameters.search_margin * mesh.largest_radius(),
             .5 * mesh.largest_radius(),
             // Fibers of a fabric do not fold back on themselves.
             parameters.self_contact == SelfContact::always ||
                 (parameters.self_contact == SelfContact::automatic &&
                  !fibers.pattern) ?
               ProximitySearch::Pairs::of_one_too :
               ProximitySearch::Pairs::of_two_fibers,
             mesh.images())
    , woven_pairs(find_woven_pairs(this->fibers, mesh.images()))
  {}



  void
  ContactGenerator::place_at(ContactElement      &contact,
                             const ParameterPair &u) const
  {
    for (unsigned int s = 0; s < 2; ++s)
      {
        contact.points[s]      = mesh.locate(contact.fibers[s], u[s]);
        contact.first_nodes[s] = mesh.first_node(contact.points[s].element);
        contact.weights[s]     = shape_values(contact.points[s].xi);
      }
  }



  void
  ContactGenerator::let_points_follow(std::vector<ContactElement> &contacts,
                                      const DofVector             &q,
                                      const ContactState          &state) const
  {
    for (ContactElement &contact : contacts)
      {
        const ContactZone &zone = state.zones[contact.zone];
        if (zone.crossing && zone.range[0][0] == zone.range[0][1])
          continue; // from above
        // On axes that meet, no direction is the normal by their distance.
        if ((mesh.section(q, contact.points[0]).center -
             mesh.section(q, contact.points[1]).center)
              .norm() < least_distance * mesh.smallest_radius())
          continue;
        contact.following   = zone.crossing ? ContactElement::Points::closest :
                                              ContactElement::Points::on_plane;
        contact.orientation = zone.side;
        if (!zone.crossing)
          contact.orientation =
            sign(mesh.section(q, contact.points[0])
                   .tangent()
                   .dot(mesh.section(q, contact.points[1]).tangent()));
        for (unsigned int s = 0; s < 2; ++s)
          contact.u[s] = mesh.parameter(contact.points[s]);
      }
  }



  ContactElement
  ContactGenerator::new_element(const unsigned int   zone,
                                const ParameterPair &u,
                                const ContactState  &state) const
  {
    const ContactZone &of = state.zones[zone];
    ContactElement     contact;
    contact.zone   = zone;
    contact.fibers = of.fibers;
    place_at(contact, u);
    for (unsigned int s = 0; s < 2; ++s)
      contact.radii[s] = mesh.lines()[of.fibers[s]].radius;
    const double radius    = std::min(contact.radii[0], contact.radii[1]);
    contact.normal         = Vector3::Zero();
    contact.offset         = 0;
    contact.part           = of.part_at(u[0]);
    contact.stiffness      = of.stiffness[contact.part].second;
    contact.length         = 0;
    contact.spread         = 0;
    contact.skewness       = {{1, 1}};
    contact.regularization = parameters.line_stiffness > 0 ?
                               0. :
                               parameters.largest_penetration * radius / 4;
    contact.friction_limit = 0;
    contact.friction_normal.setZero();
    contact.elastic_slip = parameters.elastic_slip * radius;
    contact.slip_before.setZero();
    contact.separation_before.setZero();
    contact.particles = {};
    return contact;
  }



  double
  ContactGenerator::initial_stiffness(const ContactZone &zone) const
  {
    if (parameters.line_stiffness > 0)
      return parameters.line_stiffness;
    const auto &first      = mesh.lines()[zone.fibers[0]],
               &second     = mesh.lines()[zone.fibers[1]];
    const double stiffness = parameters.initial_stiffness *
                             std::min(first.young_modulus * first.radius,
                                      second.young_modulus * second.radius);
    if (!zone.crossing)
      return stiffness / (.5 * first.length / first.n_elements);

    const double penetration =
      parameters.largest_penetration * std::min(first.radius, second.radius);
    const double spread = crossing_spread(0, {{first.radius, second.radius}});
    return stiffness * penetration / crossing_law(penetration, spread, 0).force;
  }



  ContactZone
  ContactGenerator::successor(ContactZone         zone,
                              const ContactState &before) const
  {
    const auto  &pair  = zone.fibers;
    int          shift = 0; // of the predecessors, in elements
    Predecessors found = find_predecessors(before.zones, pair, zone.range);
    // What has slid over the cell's border is the zone of an image now.
    for (int way = -1; cell.images() && found.all.empty() && way <= 1; way += 2)
      {
        auto moved = zone.range;
        for (unsigned int s = 0; s < 2; ++s)
          for (double &u : moved[s])
            u += way * int(mesh.lines()[pair[s]].period);
        shift = way * int(mesh.lines()[pair[0]].period);
        found = find_predecessors(before.zones, pair, moved);
      }
    if (found.longest == nullptr)
      zone.stiffness = {{zone.range[0][1], initial_stiffness(zone)}};
    else
      {
        zone.crossing        = found.longest->crossing;
        zone.side            = found.longest->side;
        const double spacing = 1. / parameters.stations_per_element;
        zone.stiffness =
          inherited_stiffness(found, zone.range[0], spacing, shift);
        for (const ContactZone *of : found.all)
          for (const auto &[k, parts] : of->divided)
            zone.divided.emplace_back(k - int(std::lround(shift / spacing)),
                                      parts);
        // The first counts of cells that two of them have: the one with more
        // stations.
        std::sort(zone.divided.begin(),
                  zone.divided.end(),
                  [](const auto &a, const auto &b) {
                    return std::make_pair(a.first, b.second) <
                           std::make_pair(b.first, a.second);
                  });
      }
    if (const int order = superimposition(fibers, pair[0], pair[1]))
      zone.side = order;
    return zone;
  }



  std::vector<ContactElement>
  ContactGenerator::generate(const DofVector   &q_of_cell,
                             const DofVector   &q_before,
                             const ContactRule &rule,
                             ContactState      &state)
  {
    const DofVector q = cell.with_images(q_of_cell);
    ContactState    before;
    before.zones.swap(state.zones);
    std::vector<ContactElement> contacts;
    cells_may_merge = q_of_cell == q_before;
    add_proximity_zones(q, rule, before, state, contacts);
    if (rule.from_above)
      add_woven_crossings(q, rule, before, state, contacts);
    if (rule.points_follow)
      let_points_follow(contacts, q, state);
    update_seen(contacts, q, cell.with_images(q_before), rule, state);
    gather_contacts(comm, state.zones, contacts);

    // Sorted by fibers, so that predecessors are found by bisection.
    const auto comes_first = [&](const ContactZone &a, const ContactZone &b) {
      return std::tie(a.fibers, a.range) < std::tie(b.fibers, b.range);
    };
    if (std::is_sorted(state.zones.begin(), state.zones.end(), comes_first))
      return contacts;
    std::vector<unsigned int> order(state.zones.size()), rank(order.size());
    for (unsigned int z = 0; z < order.size(); ++z)
      order[z] = z;
    std::sort(order.begin(), order.end(), [&](const auto a, const auto b) {
      return comes_first(state.zones[a], state.zones[b]);
    });
    std::vector<ContactZone> sorted;
    sorted.reserve(order.size());
    for (unsigned int z = 0; z < order.size(); ++z)
      {
        rank[order[z]] = z;
        sorted.push_back(std::move(state.zones[order[z]]));
      }
    state.zones.swap(sorted);
    for (ContactElement &contact : contacts)
      contact.zone = rank[contact.zone];
    std::stable_sort(contacts.begin(),
                     contacts.end(),
                     [](const ContactElement &a, const ContactElement &b) {
                       return a.zone < b.zone;
                     });
    return contacts;
  }



  void
  ContactGenerator::add_woven_crossings(
    const DofVector             &q,
    const ContactRule           &rule,
    const ContactState          &before,
    ContactState                &state,
    std::vector<ContactElement> &contacts) const
  {
    const double margin     = parameters.search_margin * mesh.largest_radius();
    const auto [begin, end] = part_of_rank(comm, woven_pairs.size());
    for (std::size_t i = begin; i < end; ++i)
      {
        const auto   &pair = woven_pairs[i];
        ParameterPair start;
        for (unsigned int s = 0; s < 2; ++s)
          start[s] = .5 * mesh.lines()[pair[s]].n_elements;
        const ParameterPair u = plan_crossing(mesh, q, pair, start);
        ContactZone         found;
        found.fibers   = pair;
        found.range    = {{{{u[0], u[0]}}, {{u[1], u[1]}}}};
        found.crossing = true;

        state.zones.push_back(successor(found, before));
        state.zones.back().crossing = true;
        const unsigned int zone     = state.zones.size() - 1;

        ContactElement contact = new_element(zone, u, state);
        set_normal(contact, q, state);
        contact.offset = rule.allowed_overlap;
        if (contact_gap(contact, section_pair(contact, q)) < margin)
          contacts.push_back(contact);
        else
          state.zones.pop_back();
      }
  }



  void
  ContactGenerator::add_proximity_zones(const DofVector             &q,
                                        const ContactRule           &rule,
                                        const ContactState          &before,
                                        ContactState                &state,
                                        std::vector<ContactElement> &contacts)
  {
    const double margin     = parameters.search_margin * mesh.largest_radius();
    const auto  &candidates = search.candidates(q);
    // A pair of fibers is not divided.
    const auto from = [&](std::size_t i) {
      while (i > 0 && i < candidates.size() &&
             candidates[i].fibers == candidates[i - 1].fibers)
        ++i;
      return candidates.begin() + i;
    };
    const auto [begin, end] = part_of_rank(comm, candidates.size());
    for (const ProximityZone &proximity :
         find_proximity_zones(mesh, q, from(begin), from(end), margin))
      {
        const auto &pair  = proximity.fibers;
        const int   order = superimposition(fibers, pair[0], pair[1]);
        if (rule.from_above && order != 0)
          continue;
        const auto counted = counted_part(proximity);
        if (!(counted[0] < counted[1]))
          continue;

        const ZoneClass kind(mesh, q, proximity, margin);
        ContactZone     found;
        found.fibers     = pair;
        found.range      = {{proximity.range(0), proximity.range(1)}};
        found.crossing   = kind.crosses();
        ContactZone zone = successor(found, before);
        zone.crossing =
          zone.crossing ? kind.crosses_still() : kind.crosses_now();
        if (zone.crossing)
          zone.stiffness = {{found.range[0][1], largest_stiffness(zone)}};
        state.zones.push_back(zone);
        const unsigned int index = state.zones.size() - 1;

        if (!zone.crossing)
          {
            add_parallel_stations(proximity, index, q, state, contacts);
            continue;
          }

        contacts.push_back(new_element(index, *kind.closest, state));
        if (zone.side == 0)
          {
            const SectionPair x = section_pair(contacts.back(), q);
            state.zones[index].side =
              sign(kind.t1.cross(kind.t2).dot(x.head<3>() - x.segment<3>(9)));
          }
      }
  }



  std::array<double, 2>
  ContactGenerator::counted_part(const ProximityZone &zone) const
  {
    const FiberMesh::Line &line = mesh.lines()[zone.fibers[0]];
    const double           n = line.period, end = line.n_elements;
    const auto             range  = zone.range(0);
    const FiberImages     *images = cell.images();
    // Fibers of crossing tows meet once.
    if (images == nullptr ||
        superimposition(fibers, zone.fibers[0], zone.fibers[1]) != 0)
      return {{0, end}};
    if (range[1] - range[0] >= n)
      return {{n, 2 * n}};
    const double middle = .5 * (range[0] + range[1]);
    if (middle >= n && middle < 2 * n)
      return {{0, end}};
    return {{0, 0}};
  }



  void
  ContactGenerator::set_normal(ContactElement     &contact,
                               const DofVector    &q,
                               const ContactState &state) const
  {
    const ContactZone &zone   = state.zones[contact.zone];
    const Section      first  = mesh.section(q, contact.points[0]);
    const Section      second = mesh.section(q, contact.points[1]);
    const Vector3      t1 = first.tangent(), t2 = second.tangent();
    if (zone.crossing)
      {
        contact.normal = zone.side * t1.cross(t2).normalized();
        contact.spread = crossing_spread(t1.dot(t2), contact.radii);
        return;
      }

    const Vector3 tangent = mean_direction(t1, t2);
    Vector3       across  = first.center - second.center;
    across -= tangent * tangent.dot(across);
    // Coincident axes: any direction across will do to part them.
    contact.normal      = across.norm() > 1e-10 * contact.radii[0] ?
                            across.normalized() :
                            first.vector_1.normalized();
    const auto skewness = [&](const Vector3 &t) {
      const double along = contact.normal.dot(t);
      return 1 / std::sqrt(1 - along * along);
    };
    contact.skewness = {{skewness(t1), skewness(t2)}};
  }



  namespace
  {
    /** The nearest entry of the same fibers within half an element, or null. */
    const FrictionHistory *
    nearest_history(const std::vector<FrictionHistory> &history,
                    const FiberMesh                    &mesh,
                    const ContactElement               &contact,
                    const double                        u)
    {
      constexpr double       reach    = .5;
      const FrictionHistory *nearest  = nullptr;
      double                 distance = reach;
      for (auto entry =
             std::lower_bound(history.begin(),
                              history.end(),
                              contact.fibers,
                              [](const FrictionHistory &h, const auto &pair) {
                                return h.fibers < pair;
                              });
           entry != history.end() && entry->fibers == contact.fibers;
           ++entry)
        if (const double away =
              mesh.distance(contact.fibers[0], entry->u[0], u);
            away < distance)
          {
            distance = away;
            nearest  = &*entry;
          }
      return nearest;
    }
  } // namespace



  Matrix3
  ContactGenerator::turn(const ContactElement &contact,
                         const DofVector      &q_before,
                         const DofVector      &q,
                         const ContactState   &state) const
  {
    const auto tangent = [&](const DofVector &at, const unsigned int s) {
      return mesh.section(at, contact.points[s]).tangent();
    };
    // That of now for both: at right angles it can change in between.
    const double same  = sign(tangent(q, 0).dot(tangent(q, 1)));
    const auto   frame = [&](const DofVector &at) {
      ContactElement there = contact;
      set_normal(there, at, state);
      Matrix3 frame;
      frame.col(0) = there.normal;
      frame.col(1) = (tangent(at, 0) + same * tangent(at, 1)).normalized();
      frame.col(2) = frame.col(0).cross(frame.col(1));
      return frame;
    };
    return frame(q) * frame(q_before).transpose();
  }



  void
  ContactGenerator::update(std::vector<ContactElement> &contacts,
                           const DofVector             &q,
                           const DofVector             &q_before,
                           const ContactRule           &rule,
                           const ContactState          &state) const
  {
    update_seen(
      contacts, cell.with_images(q), cell.with_images(q_before), rule, state);
  }



  void
  ContactGenerator::update_seen(std::vector<ContactElement> &contacts,
                                const DofVector             &q,
                                const DofVector             &q_before,
                                const ContactRule           &rule,
                                const ContactState          &state) const
  {
    for (ContactElement &contact : contacts)
      {
        contact.stiffness =
          state.zones[contact.zone].stiffness[contact.part].second;
        if (contact.following != ContactElement::Points::fixed)
          {
            normal_energy(contact, mesh, q);
            // Points that cannot be followed stay where they were found: a
            // contact that is dropped would leave its force out of balance.
            if (contact.lost)
              contact.following = ContactElement::Points::fixed;
            else
              place_at(contact, contact.u);
          }
        set_normal(contact, q, state);
        const SectionPair x = section_pair(contact, q);
        if (contact.following == ContactElement::Points::fixed)
          {
            contact.gap = contact_gap(contact, x);
            contact.normal_force =
              contact_normal_law(contact, -contact.gap).force;
          }
        place_particles(contact, x);
        if (!rule.friction)
          continue;

        contact.normal_force_before = contact.normal_force;
        contact.friction_normal     = contact.normal;
        contact.friction_limit =
          parameters.friction_coefficient * contact.normal_force;
        // What was before has turned with the two fibers since.
        const Matrix3 turned = turn(contact, q_before, q, state);
        contact.separation_before =
          turned *
          particle_separation(contact, section_pair(contact, q_before));
        contact.slip_before.setZero();
        if (const FrictionHistory *history = nearest_history(
              state.history, mesh, contact, mesh.parameter(contact.points[0])))
          {
            const Vector3 slip = turned * history->slip;
            contact.slip_before =
              slip - contact.normal * contact.normal.dot(slip);
          }
      }
  }



  bool
  ContactGenerator::may_pass(const DofVector &before_in_cell,
                             const DofVector &after_in_cell) const
  {
    const DofVector before = cell.with_images(before_in_cell),
                    after  = cell.with_images(after_in_cell);
    return searches() && fiberloom::may_pass(mesh,
                                             search.meeting(before, after),
                                             before,
                                             after);
  }



  unsigned int
  ContactGenerator::crossings_out_of_order(const DofVector &q_of_cell) const
  {
    const DofVector q     = cell.with_images(q_of_cell);
    unsigned int    wrong = 0;
    for (const auto &pair : woven_pairs)
      {
        ParameterPair start;
        for (unsigned int s = 0; s < 2; ++s)
          start[s] = .5 * mesh.lines()[pair[s]].n_elements;
        const ParameterPair u = plan_crossing(mesh, q, pair, start);
        const double        height =
          mesh.section(q, mesh.locate(pair[0], u[0])).center.z() -
          mesh.section(q, mesh.locate(pair[1], u[1])).center.z();
        wrong += height * superimposition(fibers, pair[0], pair[1]) <= 0;
      }
    return wrong;
  }
} // namespace fiberloom
