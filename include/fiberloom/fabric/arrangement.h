// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_fabric_arrangement_h
#define fiberloom_fabric_arrangement_h

#include <fiberloom/fabric/curve.h>

#include <array>

namespace fiberloom
{
  /**
   * Centres of a hexagonal bundle across its fibers, ring by ring from the
   * one in the middle, neighbours at distance 1. Throws InputError when
   * @p n_fibers is none of 1, 7, 19, 37, 61, ...
   */
  std::vector<std::array<double, 2>>
  hexagon(const unsigned int n_fibers);

  /**
   * A helix around the axis x, its middle at x = 0, right-handed for positive
   * @p turns .
   */
  Curve
  helix(const double length,
        const double radius,
        const double turns,
        const double start_angle);
} // namespace fiberloom

#endif
