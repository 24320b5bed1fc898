// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_simulation_error_estimate_h
#define fiberloom_simulation_error_estimate_h

#include <fiberloom/base/statistics.h>

#include <fiberloom/stages/stage.h>

#include <mpi.h>

#include <functional>
#include <string>
#include <vector>

namespace fiberloom
{
  /** An increment that led from one state in balance to another. */
  struct LastIncrement
  {
    const std::string &stage;
    const State       &before, &found;
  };

  /**
   * How far the loading curve of a stage is from the converged one at the end
   * of its last increment @p last . From the state found, a few iterations are
   * done with elements half as long, with twice the stations, with stiffer
   * contact, or with cells of the matrix half as large; what changes in the
   * curve is taken on to the limit. NaN where that is not to be had. @p ask is
   * called before each iteration and may throw. Collective. Section 4.6 of the
   * theory.
   */
  ErrorEstimate
  estimate_error(const Scene                 &scene,
                 const LastIncrement         &last,
                 const MPI_Comm               comm,
                 const std::function<void()> &ask);

  /** Lines of a log that tell of an estimate. */
  std::vector<std::string>
  described(const ErrorEstimate &error);
} // namespace fiberloom

#endif
