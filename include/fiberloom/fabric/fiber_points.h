// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_fabric_fiber_points_h
#define fiberloom_fabric_fiber_points_h

#include <fiberloom/fabric/fiber_set.h>

#include <string>
#include <vector>

namespace fiberloom
{
  /** A point of a fiber's axis that the user named. */
  struct FiberPoint
  {
    unsigned int fiber;
    std::string  name;     // "start", "end", "at 0.5"
    double       position; // in nodes from the start, not always whole

    /**
     * Number of the node of the fiber that is nearest, counted from its start.
     */
    unsigned int
    nearest_node() const;

    /** Whether it is a node. */
    bool
    is_node() const;
  };

  /**
   * Texts that say how fibers and points are to be named, for error messages.
   */
  extern const std::string fibers_allowed, points_allowed;

  /**
   * The fibers of a list such as "all", "0, 3-5", "warp" or "fill 0-2", where
   * the numbers after a family are those of tows. Throws InputError.
   */
  std::vector<unsigned int>
  find_fibers(const std::string &list, const FiberSet &set);

  /**
   * The points of a list such as "0 start, 3-5 end, all at 0.5, warp 2 end",
   * the number after "at" being the fraction of the fiber's length; "whole"
   * stands for all nodes of a fiber. Throws InputError.
   */
  std::vector<FiberPoint>
  find_points(const std::string &list, const FiberSet &set);
} // namespace fiberloom

#endif
