// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/parameters.h>

#include <fiberloom/stages/stage.h>

#include <algorithm>

namespace fiberloom
{
  ContactRule
  Stage::rule(const double) const
  {
    ContactRule rule;
    rule.friction = scene.parameters.contact.friction_coefficient > 0;
    return rule;
  }



  double
  Stage::end_of_increment(const double load, const double step) const
  {
    const double stop = next_stop(load), end = load + step;
    return end > stop - .01 * step ? stop : end;
  }



  unsigned int
  Stage::n_increments(const State &state,
                      const double load,
                      const double step) const
  {
    unsigned int n = 0;
    for (double at = load, length = step; at < 1; ++n)
      {
        at = end_of_increment(at, length);
        length =
          way() && way()->ends_leg(at) ?
            first_step(state) :
            std::min(scene.parameters.solver.growth * length, largest_step());
      }
    return n;
  }
} // namespace fiberloom
