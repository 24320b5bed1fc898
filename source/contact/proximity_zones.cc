// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/contact/proximity_zones.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace fiberloom
{
  const ProximityZone::Match &
  ProximityZone::closest() const
  {
    return *std::min_element(matches.begin(),
                             matches.end(),
                             [](const Match &a, const Match &b) {
                               return a.distance < b.distance;
                             });
  }



  std::array<double, 2>
  ProximityZone::range(const unsigned int side) const
  {
    const auto [least, most] =
      std::minmax_element(matches.begin(),
                          matches.end(),
                          [side](const Match &a, const Match &b) {
                            return a.pieces[side] < b.pieces[side];
                          });
    return {{.5 * least->pieces[side], .5 * (most->pieces[side] + 1)}};
  }



  namespace
  {
    using Match = ProximityZone::Match;

    bool
    adjacent(const Match &a, const Match &b)
    {
      for (unsigned int s = 0; s < 2; ++s)
        if (a.pieces[s] + 1 < b.pieces[s] || b.pieces[s] + 1 < a.pieces[s])
          return false;
      return true;
    }

    /** Splits the matches of one pair of fibers into connected zones. */
    void
    append_zones(const std::array<unsigned int, 2> &fibers,
                 const std::vector<Match>          &matches,
                 std::vector<ProximityZone>        &zones)
    {
      std::vector<unsigned int> root(matches.size());
      std::iota(root.begin(), root.end(), 0);
      const auto find = [&root](unsigned int i) {
        while (root[i] != i)
          i = root[i] = root[root[i]];
        return i;
      };

      // Matches are sorted by the first piece: only few lie behind in reach.
      for (unsigned int i = 0; i < matches.size(); ++i)
        for (unsigned int j = i;
             j-- > 0 && matches[j].pieces[0] + 1 >= matches[i].pieces[0];)
          if (adjacent(matches[i], matches[j]))
            {
              const unsigned int a = find(i), b = find(j);
              root[std::max(a, b)] = std::min(a, b);
            }

      std::vector<unsigned int> zone_of_root(matches.size(), -1);
      for (unsigned int i = 0; i < matches.size(); ++i)
        {
          unsigned int &zone = zone_of_root[find(i)];
          if (zone == static_cast<unsigned int>(-1))
            {
              zone = zones.size();
              zones.push_back({fibers, {}});
            }
          zones[zone].matches.push_back(matches[i]);
        }
    }
  } // namespace



  std::vector<ProximityZone>
  find_proximity_zones(const FiberMesh        &mesh,
                       const DofVector        &q,
                       const CandidateIterator begin,
                       const CandidateIterator end,
                       const double            margin)
  {
    const auto node = [&](const unsigned int fiber, const unsigned int n) {
      return q.segment<3>(9 * (mesh.lines()[fiber].first_node + n));
    };

    std::vector<ProximityZone> zones;
    std::vector<Match>         matches;
    for (auto pair = begin; pair != end;)
      {
        const auto   fibers = pair->fibers;
        const double reach  = mesh.lines()[fibers[0]].radius +
                             mesh.lines()[fibers[1]].radius + margin;
        matches.clear();
        for (; pair != end && pair->fibers == fibers; ++pair)
          {
            const auto &pieces = pair->pieces;
            const auto  distance =
              segment_distance(node(fibers[0], pieces[0]),
                               node(fibers[0], pieces[0] + 1),
                               node(fibers[1], pieces[1]),
                               node(fibers[1], pieces[1] + 1));
            if (distance.distance < reach)
              matches.push_back({pieces,
                                 {{.5 * (pieces[0] + distance.s),
                                   .5 * (pieces[1] + distance.t)}},
                                 distance.distance});
          }
        append_zones(fibers, matches, zones);
      }
    return zones;
  }



  Predecessors
  find_predecessors(const std::vector<ContactZone>             &zones,
                    const std::array<unsigned int, 2>          &fibers,
                    const std::array<std::array<double, 2>, 2> &range)
  {
    // A part may be a point: a crossing that moves keeps its zone.
    constexpr double slack = .25;

    const auto first =
      std::lower_bound(zones.begin(),
                       zones.end(),
                       fibers,
                       [](const ContactZone &zone, const auto &pair) {
                         return zone.fibers < pair;
                       });
    Predecessors found;
    double       longest = 0;
    for (auto zone = first; zone != zones.end() && zone->fibers == fibers;
         ++zone)
      {
        double shared = 1e300;
        for (unsigned int s = 0; s < 2; ++s)
          shared = std::min(shared,
                            std::min(range[s][1], zone->range[s][1]) -
                              std::max(range[s][0], zone->range[s][0]) + slack);
        if (shared <= 0)
          continue;
        found.all.push_back(&*zone);
        if (shared > longest)
          {
            longest       = shared;
            found.longest = &*zone;
          }
      }
    return found;
  }



  std::vector<std::pair<double, double>>
  inherited_stiffness(const Predecessors          &before,
                      const std::array<double, 2> &range,
                      const double                 cell,
                      const double                 shift)
  {
    std::vector<std::pair<double, double>> found;
    double                                 border = range[0];
    for (const ContactZone *zone : before.all)
      {
        double begin = zone->range[0][0] - shift;
        for (const auto &[end_before, stiffness] : zone->stiffness)
          {
            const double end     = std::min(end_before - shift, range[1]);
            const double covered = found.empty() ? border : found.back().first;
            if (end > covered && begin < range[1])
              {
                if (found.empty() || found.back().second != stiffness)
                  {
                    if (!found.empty())
                      border = found.back().first =
                        std::max(border,
                                 cell *
                                   std::round(.5 * (covered + begin) / cell));
                    found.emplace_back(end, stiffness);
                  }
                found.back().first = end;
              }
            begin = end;
          }
      }
    if (found.empty()) // a point, or next to all of them
      found.push_back(
        before.longest->stiffness[before.longest->part_at(range[0] + shift)]);
    found.back().first = range[1];
    return found;
  }
} // namespace fiberloom
