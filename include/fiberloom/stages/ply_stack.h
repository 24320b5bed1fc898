// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_stages_ply_stack_h
#define fiberloom_stages_ply_stack_h

#include <fiberloom/stages/stage.h>

namespace fiberloom
{
  /**
   * Lowers the plies of a periodic cell one after the other, as they are, until
   * each overlaps what is below by @p depth [mm], or by up to a hundredth of
   * the radius more, where they are closest. @p periods : of the cell, one a
   * column [mm].
   */
  void
  close_stack(const Scene           &scene,
              const Eigen::Matrix2d &periods,
              const double           depth,
              DofVector             &q);
} // namespace fiberloom

#endif
