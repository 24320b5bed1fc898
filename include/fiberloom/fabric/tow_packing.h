// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_fabric_tow_packing_h
#define fiberloom_fabric_tow_packing_h

#include <array>
#include <vector>

namespace fiberloom
{
  /** Position of a fiber in its tow's section: across the tow, and up. */
  using SectionPoint = std::array<double, 2>;

  /**
   * Numbers of fibers per layer, bottom to top, for @p n_fibers : a hexagon
   * of layers as flat as the paper's tows, whose neighbouring layers stagger.
   */
  std::vector<unsigned int>
  default_layers(const unsigned int n_fibers);

  /**
   * Centres of the fibers of a tow, in units of the fiber radius, the tow's
   * centre at the origin. Each layer is staggered by half a @p spacing over
   * the one below, sqrt(3)/2 @p spacing higher, so that no two fibers are
   * closer than @p spacing (design: a tow whose layers do not stagger cannot
   * be woven). Throws InputError when two centres are closer than 2.
   */
  std::vector<SectionPoint>
  tow_packing(const std::vector<unsigned int> &layers, const double spacing);
} // namespace fiberloom

#endif
