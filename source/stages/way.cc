// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/parameter_catalogue.h>

#include <fiberloom/stages/way.h>

#include <algorithm>
#include <cmath>

namespace fiberloom
{
  void
  Way::declare(ParameterCatalogue  &catalogue,
               std::vector<double> &turning_points,
               const std::string   &whole,
               const int            lowest)
  {
    catalogue.add("Way",
                  turning_points,
                  "Points between which the test goes to and fro, beginning at "
                  "0, as parts of " +
                    whole +
                    ": 1, 0, 1, 0 are two cycles of loading and unloading.",
                  Allowed::list_of(Allowed::from_to(lowest, 1), 1));
  }



  void
  Way::check(const std::vector<double> &turning_points,
             const std::string         &where)
  {
    constexpr double shortest = 1e-3;
    double           from     = 0;
    for (unsigned int i = 0; i < turning_points.size(); ++i)
      {
        const double to = turning_points[i];
        if (std::abs(to - from) < shortest &&
            !(i == 0 && to == 0 && turning_points.size() > 1))
          throw InputError(
            where + " = " + exact_text(turning_points) + ": from " +
            exact_text(from) + " to " + exact_text(to) +
            " it is no way; allowed: points at least " + exact_text(shortest) +
            " apart, the first of them from 0");
        from = to;
      }
  }



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
