// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/stop_request.h>

#include <deal.II/base/mpi.h>

#include <array>
#include <csignal>
#include <ctime>
#include <filesystem>

namespace fiberloom
{
  namespace
  {
    constexpr std::array<int, 3> signals = {{SIGTERM, SIGINT, SIGUSR1}};

    // causes other than the number of a signal
    constexpr int stop_file_found = 1000, wall_time_used = 1001;

    // A terminal and a launcher may both pass on the same request.
    constexpr std::time_t same_request = 3; // [s]

    volatile std::sig_atomic_t received_signal = 0;
    volatile std::time_t       received_at     = 0;

    extern "C" void
    remember_signal(const int signal)
    {
      const std::time_t now = std::time(nullptr);
      if (received_signal == 0)
        received_at = now;
      else if (signal == received_signal && signal != SIGUSR1 &&
               now > received_at + same_request)
        {
          std::signal(signal, SIG_DFL);
          std::raise(signal);
        }
      received_signal = signal;
    }
  } // namespace

  StopRequest::StopRequest(const MPI_Comm     comm,
                           const std::string &output_directory,
                           const double       maximal_wall_time,
                           const std::chrono::steady_clock::time_point start)
    : comm(comm)
    , stop_file(output_directory + "/stop")
    , maximal_wall_time(maximal_wall_time)
    , start(start)
  {
    received_signal = 0;
    for (const int signal : signals)
      std::signal(signal, remember_signal);
  }

  StopRequest::~StopRequest()
  {
    for (const int signal : signals)
      std::signal(signal, SIG_DFL);
  }

  int
  StopRequest::find_cause() const
  {
    if (received_signal != 0)
      return received_signal;
    // one clock and one view of the file system decide
    if (dealii::Utilities::MPI::this_mpi_process(comm) != 0)
      return 0;
    std::error_code ignored;
    if (std::filesystem::remove(stop_file, ignored))
      return stop_file_found;
    const std::chrono::duration<double> used =
      std::chrono::steady_clock::now() - start;
    if (maximal_wall_time > 0 && used.count() > maximal_wall_time)
      return wall_time_used;
    return 0;
  }

  bool
  StopRequest::requested()
  {
    if (cause == 0)
      cause = dealii::Utilities::MPI::max(find_cause(), comm);
    return cause != 0;
  }

  std::string
  StopRequest::reason() const
  {
    switch (cause)
      {
        case 0:
          return "";
        case SIGTERM:
          return "signal SIGTERM";
        case SIGINT:
          return "signal SIGINT";
        case SIGUSR1:
          return "signal SIGUSR1";
        case stop_file_found:
          return "file " + stop_file;
        default:
          return "maximal wall time used up";
      }
  }
} // namespace fiberloom
