// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_base_log_h
#define fiberloom_base_log_h

#include <fiberloom/base/file_descriptor.h>

#include <mpi.h>

#include <chrono>
#include <memory>
#include <string>

namespace fiberloom
{
  /**
   * What the user reads: rank 0 writes each line to the screen and to log.txt,
   * the other ranks nothing. Every line is out when write() returns, so that
   * a killed run leaves all it said. A screen or file that takes nothing is no
   * reason to lose the run.
   */
  class Log
  {
  public:
    explicit Log(const MPI_Comm comm);

    /**
     * From now on writes log.txt in @p directory , too: first @p title , which
     * tells one run's log from another's, then what the screen has shown
     * before. With @p kept a log that begins with that title goes on after so
     * many bytes; all others are replaced. Call it only when the input is
     * accepted.
     */
    void
    open(const std::string  &directory,
         const std::string  &title,
         const std::uint64_t kept = 0);

    /** One line, or several; ends the last one. */
    void
    write(const std::string &text);

    /** Seconds since the last line. */
    double
    silence() const;

    /** Bytes of log.txt so far; 0 on other ranks. */
    std::uint64_t
    size() const
    {
      return written;
    }

    /** Waits until what is written is on the disk. */
    void
    synchronise();

  private:
    const bool                            is_first_rank;
    std::unique_ptr<FileDescriptor>       file;
    std::string                           before_open;
    std::uint64_t                         written = 0;
    std::chrono::steady_clock::time_point last_line =
      std::chrono::steady_clock::now();

    void
    write_to_file(const std::string &text);
  };
} // namespace fiberloom

#endif
