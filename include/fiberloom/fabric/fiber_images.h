// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_fabric_fiber_images_h
#define fiberloom_fabric_fiber_images_h

#include <fiberloom/fabric/fiber_set.h>

#include <array>
#include <vector>

namespace fiberloom
{
  /** A node of a fiber, so many periods of the cell away along x and y. */
  struct NodeImage
  {
    unsigned int       node;
    std::array<int, 2> periods;
  };

  /** Index of the family's own direction: 0 along x, 1 along y. */
  inline unsigned int
  direction(const Tow &tow)
  {
    return tow.family == Tow::Family::fill ? 1 : 0;
  }

  /**
   * The fibers of a periodic cell as contact sees them. Each lasts one period
   * beyond both of its ends; behind them come, in the same order, the same
   * fibers once more, one period further across. Nothing else is needed: of all
   * pairs of fibers of the endless fabric that differ by periods only, one is a
   * pair of these.
   */
  struct FiberImages
  {
    FiberSet               fibers;
    std::vector<NodeImage> nodes; // of those of a FiberMesh of these fibers

    /** Images of the fibers of @p cell , which has a cell. */
    explicit FiberImages(const FiberSet &cell);

    unsigned int
    n_originals() const
    {
      return fibers.fibers.size() / 2;
    }

    /** Whether a pair of fibers stands for those that differ by periods: both
     * of the cell, or one of them and an image of the same family. */
    bool
    is_pair(const unsigned int first, const unsigned int second) const;
  };
} // namespace fiberloom

#endif
