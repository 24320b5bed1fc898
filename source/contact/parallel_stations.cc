// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/parameters.h>

#include <fiberloom/contact/contact_generator.h>
#include <fiberloom/contact/contact_law.h>

#include <algorithm>
#include <cmath>

// The stations of contact along fibers that run side by side.

namespace fiberloom
{
  namespace
  {
    // Stations over half the length on which two straight fibers overlap.
    constexpr double       stations_over_overlap = 3;
    constexpr unsigned int most_stations         = 64; // in a cell

    // A cell gets fewer stations when they would do for this part of the
    // overlap.
    constexpr double coarsened_below = .25;
  } // namespace



  std::optional<double>
  ContactGenerator::cut_second(const ProximityZone &zone,
                               const double         u,
                               const DofVector     &q) const
  {
    // The search starts from the closest match on this piece or, just beyond
    // the zone, on the next one.
    const ProximityZone::Match *nearest = nullptr;
    const auto                  away = [u](const ProximityZone::Match &match) {
      return std::abs(int(match.pieces[0]) - int(2 * u));
    };
    for (const auto &match : zone.matches)
      if (away(match) <= 1 &&
          (nearest == nullptr ||
           std::make_pair(away(match), match.distance) <
             std::make_pair(away(*nearest), nearest->distance)))
        nearest = &match;
    if (nearest == nullptr)
      return {};
    return cut_by_plane(mesh,
                        q,
                        mesh.section(q, mesh.locate(zone.fibers[0], u)),
                        zone.fibers[1],
                        nearest->u[1]);
  }



  double
  ContactGenerator::faced_part(const std::array<unsigned int, 2> &fibers,
                               const double                       cut,
                               const double                       width) const
  {
    const auto &first  = mesh.lines()[fibers[0]],
               &second = mesh.lines()[fibers[1]];
    const double faced = width * first.length / first.n_elements *
                         second.n_elements / second.length;
    return std::clamp(.5 + std::min(cut, second.n_elements - cut) / faced,
                      0.,
                      1.);
  }



  unsigned int
  ContactGenerator::stations_in_cell(const ProximityZone &zone,
                                     const double         u,
                                     const double         cell,
                                     const DofVector     &q,
                                     const unsigned int   now) const
  {
    const auto cut = cut_second(zone, u, q);
    if (!cut || *cut < 0 || *cut > mesh.lines()[zone.fibers[1]].n_elements)
      return now;
    const auto &first  = mesh.lines()[zone.fibers[0]],
               &second = mesh.lines()[zone.fibers[1]];
    const double cosine =
      mesh.section(q, mesh.locate(zone.fibers[0], u))
        .tangent()
        .dot(mesh.section(q, mesh.locate(zone.fibers[1], *cut)).tangent());
    const double overlap =
      .5 * crossing_spread(cosine, {{first.radius, second.radius}}) *
      std::sqrt(parameters.largest_penetration *
                std::min(first.radius, second.radius));
    const double spacing = cell * first.length / first.n_elements;
    const auto   needed  = [&](const double length) {
      unsigned int parts = 1;
      while (parts < most_stations &&
             spacing * stations_over_overlap > parts * length)
        parts *= 2;
      return parts;
    };
    const unsigned int kept =
      cells_may_merge ? std::min(now, needed(coarsened_below * overlap)) : now;
    return std::max(kept, needed(overlap));
  }



  void
  ContactGenerator::add_parallel_stations(
    const ProximityZone         &proximity,
    const unsigned int           zone,
    const DofVector             &q,
    ContactState                &state,
    std::vector<ContactElement> &contacts) const
  {
    const auto  &pair    = proximity.fibers;
    const auto   counted = counted_part(proximity);
    const double reach   = mesh.lines()[pair[0]].radius +
                         mesh.lines()[pair[1]].radius +
                         parameters.search_margin * mesh.largest_radius();
    const double       cell   = 1. / parameters.stations_per_element; // in u
    const auto         range  = proximity.range(0);
    const unsigned int before = contacts.size();
    const auto         divided_before = std::move(state.zones[zone].divided);
    state.zones[zone].divided.clear();

    // A station just beyond the zone may stand for a length within it.
    const int first = std::lround(counted[0] / cell),
              last  = std::lround(counted[1] / cell);
    for (int k = std::max<int>(first, std::floor(range[0] / cell - .5));
         k < last && (k - .5) * cell < range[1];
         ++k)
      {
        const auto         was = std::lower_bound(divided_before.begin(),
                                          divided_before.end(),
                                          k,
                                          [](const auto &cell, const int k) {
                                            return cell.first < k;
                                          });
        const unsigned int parts =
          stations_in_cell(proximity,
                           (k + .5) * cell,
                           cell,
                           q,
                           was != divided_before.end() && was->first == k ?
                             was->second :
                             1);
        if (parts > 1)
          state.zones[zone].divided.emplace_back(k, parts);
        for (unsigned int part = 0; part < parts; ++part)
          {
            const double u = (k + (part + .5) / parts) * cell;
            if (u < range[0] - .5 * cell || u >= range[1] + .5 * cell)
              continue;
            const auto cut = cut_second(proximity, u, q);
            if (!cut)
              continue;
            const double faced = faced_part(pair, *cut, cell / parts);
            if (faced <= 0)
              continue;
            const double  end    = mesh.lines()[pair[1]].n_elements;
            const double  v      = std::clamp(*cut, 0., end);
            const Section first  = mesh.section(q, mesh.locate(pair[0], u));
            const Section second = mesh.section(q, mesh.locate(pair[1], v));
            const Vector3 along =
              mean_direction(first.tangent(), second.tangent());
            if (along.cross(second.center - first.center).norm() > reach)
              continue;
            contacts.push_back(new_element(zone, {{u, v}}, state));
            contacts.back().length =
              std::abs(first.center_derivative.dot(along)) * faced * cell /
              parts;
          }
      }

    // A zone too short for the spacing still has its closest point.
    if (contacts.size() > before)
      return;
    if (const auto closest =
          inner_closest_point(mesh, q, pair, proximity.closest().u))
      {
        contacts.push_back(new_element(zone, *closest, state));
        const auto &line       = mesh.lines()[pair[0]];
        contacts.back().length = cell * line.length / line.n_elements;
      }
  }
} // namespace fiberloom
