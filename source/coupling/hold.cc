// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/coupling/hold.h>

#include <vector>

namespace fiberloom
{
  namespace
  {
    // Components along (first, second, axis): centre 0-2, r g1 3-5, r g2 6-8.
    // A section vector's own component is its length, which is never held.
    std::vector<unsigned int>
    held_components(const Hold hold)
    {
      switch (hold)
        {
          case Hold::clamped:
            return {0, 1, 2, 4, 5, 6, 8};
          case Hold::direction:
            return {0, 1, 2, 4, 5};
          case Hold::pinned:
            return {0, 1, 2, 4};
          case Hold::center:
            return {0, 1, 2};
          case Hold::axial:
            return {2};
        }
      return {};
    }
  } // namespace



  Attachment
  attach(const DofVector   &q,
         const unsigned int node,
         const unsigned int body,
         const Hold         hold)
  {
    Attachment attachment;
    attachment.node = node;
    attachment.body = body;
    for (const unsigned int component : held_components(hold))
      attachment.held.set(component);

    const Vector3 first = q.segment<3>(9 * node + 3).normalized();
    const Vector3 axis  = first.cross(q.segment<3>(9 * node + 6)).normalized();
    attachment.frame.col(0) = first;
    attachment.frame.col(1) = axis.cross(first);
    attachment.frame.col(2) = axis;
    return attachment;
  }
} // namespace fiberloom
