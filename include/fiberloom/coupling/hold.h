// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_coupling_hold_h
#define fiberloom_coupling_hold_h

#include <fiberloom/coupling/rigid_body.h>

namespace fiberloom
{
  /** How a body holds a node of a fiber. */
  enum class Hold
  {
    clamped,   // centre, and the directions of both section vectors
    direction, // centre, and the direction of the first section vector
    pinned,    // centre, and no spin about the fiber's axis
    center,    // centre alone
    axial      // centre along the fiber's axis alone
  };

  /**
   * The attachment of @p node to @p body , its frame along the section vectors
   * that the node has in @p q (columns: first, second, axis); the body's
   * axes are taken to be those of the sample.
   */
  Attachment
  attach(const DofVector   &q,
         const unsigned int node,
         const unsigned int body,
         const Hold         hold);
} // namespace fiberloom

#endif
