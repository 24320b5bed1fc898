// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/stages/way.h>

#include <algorithm>
#include <cmath>

namespace fiberloom
{
  Way::Way(const std::vector<double> &turning_points)
    : points{0}
    , loads{0}
  {
    for (const double point : turning_points)
      if (points.size() > 1 || point != 0)
        {
          whole_length += std::abs(point - points.back());
          points.push_back(point);
          loads.push_back(whole_length);
        }
    for (double &load : loads)
      load /= whole_length;
  }



  unsigned int
  Way::leg(const double load) const
  {
    return std::upper_bound(loads.begin() + 1, loads.end() - 1, load) -
           loads.begin() - 1;
  }



  double
  Way::at(const double load) const
  {
    const unsigned int l    = leg(load);
    const double       part = (load - loads[l]) / (loads[l + 1] - loads[l]);
    return part < 1 ? points[l] + part * (points[l + 1] - points[l]) :
                      points[l + 1];
  }



  double
  Way::next_turn(const double load) const
  {
    return loads[leg(load) + 1];
  }



  bool
  Way::ends_leg(const double load) const
  {
    return load > 0 && std::binary_search(loads.begin(), loads.end(), load);
  }



  double
  Way::farthest() const
  {
    unsigned int farthest = 0;
    for (unsigned int i = 1; i < points.size(); ++i)
      if (std::abs(points[i]) >= std::abs(points[farthest]))
        farthest = i;
    return loads[farthest];
  }
} // namespace fiberloom
