// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_simulation_coarse_start_h
#define fiberloom_simulation_coarse_start_h

#include <fiberloom/simulation/stage_run.h>

#include <optional>

namespace fiberloom
{
  /**
   * Nested iteration: the end of a stage of the same fabric with half
   * as many elements, which starts from one with a quarter, and so on, carried
   * over to the mesh of @p scene , by the stage's fast path. Nothing where
   * fewer elements would not show each crossing or do not come to rest. Adds to
   * @p statistics , which name the stage. Throws StopRequested on request.
   */
  std::optional<State>
  start_coarsely(const Scene      &scene,
                 const RunContext &context,
                 StageStatistics  &statistics);
} // namespace fiberloom

#endif
