// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_fabric_superimposition_h
#define fiberloom_fabric_superimposition_h

#include <fiberloom/fabric/fiber_set.h>

namespace fiberloom
{
  /**
   * 1 if @p first is a fiber of a tow that the pattern puts above the tow of
   * @p second where they cross, -1 if below, 0 if their tows do not cross.
   */
  inline int
  superimposition(const FiberSet    &set,
                  const unsigned int first,
                  const unsigned int second)
  {
    const Tow &a = set.tows[set.fibers[first].tow];
    const Tow &b = set.tows[set.fibers[second].tow];
    if (!set.pattern || a.family == b.family)
      return 0;
    const bool a_is_warp = a.family == Tow::Family::warp;
    const bool warp_above =
      set.pattern->warp_above(a_is_warp ? a.number : b.number,
                              a_is_warp ? b.number : a.number);
    return warp_above == a_is_warp ? 1 : -1;
  }
} // namespace fiberloom

#endif
