// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_simulation_coarse_start_h
#define fiberloom_simulation_coarse_start_h

#include <fiberloom/base/log.h>
#include <fiberloom/base/statistics.h>

#include <fiberloom/stages/stage.h>

#include <functional>
#include <optional>
#include <string>

namespace fiberloom
{
  /**
   * Nested iteration: the end of the stage @p name of the same fabric with half
   * as many elements, which starts from one with a quarter, and so on, carried
   * over to the mesh of @p scene , by the stage's fast path. Nothing where
   * fewer elements would not show each crossing or do not come to rest. Throws
   * StopRequested when @p stop_requested says so.
   */
  std::optional<State>
  start_coarsely(const Scene                 &scene,
                 const std::string           &name,
                 StageStatistics             &statistics,
                 Log                         &log,
                 const MPI_Comm               comm,
                 const std::function<bool()> &stop_requested);
} // namespace fiberloom

#endif
