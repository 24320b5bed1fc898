// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/contact/contact_law.h>

#include <fiberloom/model/plate_group.h>
#include <fiberloom/model/plate_term.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace fiberloom
{
  namespace
  {
    PlateFriction::Section
    section_at(const DofVector &q, const PlateGroup &group)
    {
      PlateFriction::Section section = PlateFriction::Section::Zero();
      for (unsigned int a = 0; a < 3; ++a)
        section += group.weights[a] * q.segment<9>(9 * group.nodes[a]);
      return section;
    }

    /** The entry of the plate of @p contact nearest to the section, within half
     * an element, or null. */
    const PlateHistory *
    nearest_history(const std::vector<PlateHistory> &history,
                    const PlateGroup                &group,
                    const PlateContact              &contact)
    {
      const PlateHistory *nearest  = nullptr;
      double              distance = .5;
      for (auto entry =
             std::lower_bound(history.begin(),
                              history.end(),
                              std::make_pair(group.fiber, group.u - distance),
                              [](const PlateHistory &h, const auto &place) {
                                return std::make_pair(h.fiber, h.u) < place;
                              });
           entry != history.end() && entry->fiber == group.fiber &&
           entry->u < group.u + distance;
           ++entry)
        if (const double away = std::abs(entry->u - group.u);
            entry->upper == contact.upper && away < distance)
          {
            distance = away;
            nearest  = &*entry;
          }
      return nearest;
    }
  } // namespace



  template <class Visitor>
  void
  PlateTerm::visit_stations(const State &state, const Visitor &visit) const
  {
    const Plates &plates = *supports.plates;
    const Vector3 place  = state.placements[plates.body].position;
    PlateGroup    group;
    group.number = 0;
    for (unsigned int e = 0; e < mesh.n_elements(); ++e)
      {
        group.fiber             = mesh.fiber_of_element(e);
        const auto        &line = mesh.lines()[group.fiber];
        const unsigned int node = mesh.first_node(e);
        group.nodes             = {
                      {node, node + 1, node + 2, layout.body_block(plates.body)}};
        for (unsigned int k = 0; k < plates.stations_per_element; ++k)
          {
            const double along = (k + .5) / plates.stations_per_element;
            group.u            = e - line.first_element + along;
            group.weights      = shape_values(2 * along - 1);
            group.section      = section_at(state.q, group);
            PlateContact::Heights x;
            x << group.section[2], group.section[5], group.section[8],
              place.x(), place.z();
            for (const bool upper : {false, true})
              {
                const PlateContact contact{plates.stiffness *
                                             line.young_modulus * line.length /
                                             (line.n_elements *
                                              plates.stations_per_element),
                                           plates.regularization * line.radius,
                                           upper};
                visit(contact, x, group);
                ++group.number;
              }
          }
      }
  }



  void
  PlateTerm::visit_couplings(const CouplingVisitor &couple) const
  {
    if (!supports.plates)
      return;
    const unsigned int        body = layout.body_block(supports.plates->body);
    std::vector<unsigned int> blocks;
    for (unsigned int e = 0; e < mesh.n_elements(); ++e)
      {
        const unsigned int n = mesh.first_node(e);
        blocks               = {n, n + 1, n + 2, body};
        couple(blocks);
      }
  }



  double
  PlateTerm::spring() const
  {
    return supports.plates->spring * mesh.smallest_stiffness();
  }



  void
  PlateTerm::add(const State &state, Assembly &sum) const
  {
    if (!supports.plates)
      return;
    visit_stations(
      state,
      [&](const PlateContact          &contact,
          const PlateContact::Heights &x,
          PlateGroup                  &group) {
        if (!sum.touches_owned(group.nodes.data(), 4, mesh.originals()))
          return;
        if (contact.evaluate(x,
                             group.gradient,
                             sum.with_tangent() ? &group.hessian : nullptr))
          sum.scatter(group, mesh.originals());
        else
          group.gradient.setZero();
        add_friction(group, sum);
      });
    const unsigned int body  = supports.plates->body;
    const unsigned int block = layout.body_block(body);
    const int          local = layout.local_block(block);
    if (local < 0)
      return;
    sum.forces(local)[2] += spring() * state.placements[body].position.z();
    if (sum.with_tangent())
      sum.matrix().block(block, block)[6 * 2 + 2] += spring();
  }



  void
  PlateTerm::add_friction(const PlateGroup &normal, Assembly &sum) const
  {
    if (frictions.empty() || !(frictions[normal.number].limit > 0))
      return;
    PlateFrictionGroup group(normal);
    frictions[normal.number].evaluate(normal.section,
                                      group.gradient,
                                      sum.with_tangent() ? &group.hessian :
                                                           nullptr);
    sum.scatter(group, mesh.originals());
    if (sum.with_tangent() && !normal.gradient.isZero(0))
      couple_limit(normal, group, sum);
  }



  void
  PlateTerm::couple_limit(const PlateGroup         &normal,
                          const PlateFrictionGroup &friction,
                          Assembly                 &sum) const
  {
    const PlateFriction &law = frictions[normal.number];
    HeldGroup rows = sum.held_group({normal.nodes.begin(), normal.nodes.end()},
                                    mesh.originals());
    HeldGroup columns(rows);
    // The force is the slope of the energy by the gap, and the gap changes with
    // the height of the centre as much as it moves.
    PlateGroup slope = normal;
    slope.gradient =
      normal.hessian.row(0) * (normal.gradient[0] > 0 ? 1. : -1.);
    for (unsigned int a = 0; a < 4; ++a)
      {
        rows.set_force(a,
                       a < 3 ? Eigen::VectorXd(friction.force(a) / law.limit) :
                               Eigen::VectorXd(Eigen::VectorXd::Zero(6)));
        columns.set_force(a,
                          law.limit / law.normal_force_before * slope.force(a));
      }
    sum.add_product(rows, columns);
  }



  void
  PlateTerm::update(const State                     &state,
                    const DofVector                 &q_before,
                    const std::vector<PlateHistory> &history)
  {
    if (!supports.plates || !(supports.plates->friction_coefficient > 0))
      return;
    frictions.clear();
    visit_stations(
      state,
      [&](const PlateContact          &contact,
          const PlateContact::Heights &x,
          const PlateGroup            &group) {
        PlateFriction friction;
        friction.normal_force_before =
          normal_law(-contact.gap(x), contact.stiffness, contact.regularization)
            .force;
        friction.limit =
          supports.plates->friction_coefficient * friction.normal_force_before;
        friction.elastic_slip =
          supports.plates->elastic_slip * mesh.lines()[group.fiber].radius;
        friction.place_particle(group.section,
                                contact.upper ?
                                  PlateFriction::Extreme::highest :
                                  PlateFriction::Extreme::lowest);
        friction.origin = friction.place(section_at(q_before, group));
        if (const PlateHistory *entry =
              nearest_history(history, group, contact))
          friction.origin -= Eigen::Vector2d(entry->slip[0], entry->slip[1]);
        frictions.push_back(friction);
      });
  }



  std::vector<PlateHistory>
  PlateTerm::history(const State &state) const
  {
    std::vector<PlateHistory> history;
    if (!frictions.empty())
      visit_stations(
        state,
        [&](const PlateContact          &contact,
            const PlateContact::Heights &x,
            const PlateGroup            &group) {
          const PlateFriction &friction = frictions[group.number];
          if (!(friction.limit > 0) || contact.gap(x) >= 0)
            return;
          const Eigen::Vector2d slip = friction.reversible_slip(group.section);
          history.push_back(
            {group.fiber, group.u, contact.upper, {{slip[0], slip[1]}}});
        });
    return history;
  }



  double
  PlateTerm::dissipation(const State &state) const
  {
    double sum = 0;
    if (!frictions.empty())
      visit_stations(state,
                     [&](const PlateContact &,
                         const PlateContact::Heights &,
                         const PlateGroup &group) {
                       sum += frictions[group.number].dissipated_energy(
                         group.section);
                     });
    return sum;
  }



  double
  PlateTerm::energy(const State &state) const
  {
    if (!supports.plates)
      return 0;
    double energy = 0;
    visit_stations(state,
                   [&](const PlateContact          &contact,
                       const PlateContact::Heights &x,
                       const PlateGroup            &group) {
                     if (!owns(group.nodes[0]))
                       return;
                     energy += contact.energy(x);
                     if (!frictions.empty())
                       energy +=
                         frictions[group.number].law(group.section).energy;
                   });
    const Plates &plates = *supports.plates;
    const double  middle = state.placements[plates.body].position.z();
    if (owns(layout.body_block(plates.body)))
      energy += .5 * spring() * middle * middle;
    return energy;
  }
} // namespace fiberloom
