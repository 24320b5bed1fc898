// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_contact_passage_h
#define fiberloom_contact_passage_h

#include <fiberloom/contact/proximity_search.h>

#include <vector>

namespace fiberloom
{
  /**
   * Whether the centre lines of one of @p pairs come so near to each other, as
   * all nodes go straight from @p before to @p after , that they may have
   * passed through each other. Pairs that are as near at the start do not
   * count.
   *
   * Straight ways of two placements that differ by any affine motion without
   * reflection never meet, so that rotations up to half a turn are no passage.
   * By conservative advancement: pieces at a distance stay apart for as
   * long as they need to cover it.
   */
  bool
  may_pass(const FiberMesh                  &mesh,
           const std::vector<CandidatePair> &pairs,
           const DofVector                  &before,
           const DofVector                  &after);
} // namespace fiberloom

#endif
