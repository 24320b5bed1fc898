// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// The named weaves as pictures, x where the warp is above, with the share of
// such crossings and the longest float; and rows typed by the user.

#include <fiberloom/fabric/weave_pattern.h>

#include <algorithm>
#include <fstream>

using namespace fiberloom;

/** Most crossings in a row on one side along a warp tow, going round. */
unsigned int
longest_float(const WeavePattern &weave, const unsigned int n)
{
  unsigned int longest = 0;
  for (unsigned int warp = 0; warp < n; ++warp)
    for (unsigned int start = 0; start < n; ++start)
      {
        unsigned int length = 1;
        while (length < n && weave.warp_above(warp, (start + length) % n) ==
                               weave.warp_above(warp, start))
          ++length;
        longest = std::max(longest, length);
      }
  return longest;
}

void
draw(std::ostream       &output,
     const WeavePattern &weave,
     const unsigned int  n_warp,
     const unsigned int  n_fill)
{
  for (unsigned int fill = 0; fill < n_fill; ++fill)
    {
      for (unsigned int warp = 0; warp < n_warp; ++warp)
        output << (weave.warp_above(warp, fill) ? 'x' : '.');
      output << std::endl;
    }
}

int
main()
{
  std::ofstream output("output");

  const std::vector<std::pair<std::string, unsigned int>> named = {
    {"plain", 2},
    {"twill 2/2", 4},
    {"twill 3/1", 4},
    {"twill 1/3", 4},
    {"satin 5", 5},
    {"satin 8", 8}};
  for (const auto &[name, period] : named)
    {
      const WeavePattern weave(name, period, period);
      unsigned int       n_above = 0;
      for (unsigned int fill = 0; fill < period; ++fill)
        for (unsigned int warp = 0; warp < period; ++warp)
          n_above += weave.warp_above(warp, fill);
      output << name << ": share above " << 1. * n_above / (period * period)
             << ", longest float " << longest_float(weave, period) << std::endl;
      draw(output, weave, period, period);
    }

  output << "plain, 5 warp and 3 fill tows" << std::endl;
  draw(output, WeavePattern("plain", 5, 3), 5, 3);
  output << "rows, 3 warp and 2 fill tows" << std::endl;
  draw(output, WeavePattern("110 001", 3, 2), 3, 2);
  draw(output, WeavePattern("110/001", 3, 2), 3, 2);
}
