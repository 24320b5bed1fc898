// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_fabric_tow_groups_h
#define fiberloom_fabric_tow_groups_h

#include <fiberloom/fabric/fiber_file.h>
#include <fiberloom/fabric/fiber_set.h>

namespace fiberloom
{
  /**
   * Makes tows of the fibers of @p set as @p read , in the same order, says.
   * Tows of families become a fabric, whose pattern is which tow lies above at
   * each crossing. Throws InputError for fibers that run the wrong way and tows
   * that are not in order or do not cross one above the other.
   */
  void
  group_into_tows(const std::vector<FiberPoints> &read, FiberSet &set);
} // namespace fiberloom

#endif
