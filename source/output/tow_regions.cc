// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/output/tow_regions.h>

#include <algorithm>

namespace fiberloom
{
  TowRegions::TowRegions(const std::vector<TowShape> &shapes,
                         const Lattice               &lattice,
                         const double                 gap,
                         const double                 margin)
    : lattice(lattice)
    , gap(gap)
    , margin(margin)
    , candidates(lattice.size())
  {
    for (std::size_t t = 0; t < shapes.size(); ++t)
      shapes[t].visit(lattice,
                      margin,
                      [&](const Lattice::Index  &i,
                          const TowShape::Value &value) { add(t, i, value); });
  }



  void
  TowRegions::add(const int              tow,
                  const Lattice::Index  &i,
                  const TowShape::Value &value)
  {
    auto           &there = candidates[lattice.number(i)];
    const Candidate found{tow,
                          static_cast<float>(value.outside),
                          static_cast<float>(value.to_fiber)};
    // Of a tow that was seen from another piece the nearer one counts.
    auto place =
      std::find_if(there.begin(), there.end(), [tow](const Candidate &other) {
        return other.tow == tow || other.tow < 0;
      });
    if (place == there.end())
      --place; // the farthest
    if (place->tow < 0 || found.outside < place->outside)
      *place = found;
    for (; place != there.begin() && place->outside < (place - 1)->outside;
         --place)
      std::swap(*place, *(place - 1));
  }



  double
  TowRegions::level(const int              tow,
                    const Lattice::Index  &i,
                    const TowShape::Value &value) const
  {
    double level = std::max(value.outside, gap - margin);
    for (const Candidate &other : candidates[lattice.number(i)])
      if (other.tow >= 0 && other.tow != tow)
        {
          // Changes its sign where the two tows are exchanged.
          const double farther =
            value.outside + other.outside > 0 ?
              .5 * (value.outside - other.outside) :
              std::clamp<double>(.5 * (value.to_fiber - other.to_fiber),
                                 value.outside,
                                 -other.outside);
          level = std::max(level, .5 * gap + farther);
        }
    return level;
  }
} // namespace fiberloom
