// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_base_stop_request_h
#define fiberloom_base_stop_request_h

#include <mpi.h>

#include <chrono>
#include <string>

namespace fiberloom
{
  /**
   * Whether the user or the queue wants the run to end: by SIGTERM, SIGINT or
   * SIGUSR1 to any rank, by a file "stop" in the output directory, or because
   * the wall time is used up. While an object of this class lives these signals
   * only set a flag; SIGTERM or SIGINT that comes again seconds later ends the
   * process, as where it hangs in a library.
   */
  class StopRequest
  {
  public:
    /** @p maximal_wall_time : [s] since @p start , 0 for unlimited. */
    StopRequest(const MPI_Comm                              comm,
                const std::string                          &output_directory,
                const double                                maximal_wall_time,
                const std::chrono::steady_clock::time_point start =
                  std::chrono::steady_clock::now());

    ~StopRequest();

    StopRequest(const StopRequest &) = delete;
    StopRequest &
    operator=(const StopRequest &) = delete;

    /**
     * The same answer on every rank, each of which has to call it. Once true
     * it stays so. Removes the file "stop" when it is honoured.
     */
    bool
    requested();

    /** Why, in words; empty as long as nothing was requested. */
    std::string
    reason() const;

  private:
    const MPI_Comm                              comm;
    const std::string                           stop_file;
    const double                                maximal_wall_time;
    const std::chrono::steady_clock::time_point start;
    int                                         cause = 0;

    int
    find_cause() const;
  };
} // namespace fiberloom

#endif
