// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_base_log_h
#define fiberloom_base_log_h

#include <deal.II/base/mpi.h>

#include <fstream>
#include <string>

namespace fiberloom
{
  /**
   * What the user reads: rank 0 writes each line to the screen and to log.txt,
   * the other ranks nothing. Every line is out when write() returns, so that
   * a killed run leaves all it said.
   */
  class Log
  {
  public:
    explicit Log(const MPI_Comm comm);

    /**
     * From now on writes log.txt in @p directory , too, beginning with what the
     * screen has shown before. With @p append it goes on after what the file
     * holds. Call it only when the input is accepted.
     */
    void
    open(const std::string &directory, const bool append);

    /** One line, or several; ends the last one. */
    void
    write(const std::string &text);

  private:
    const bool    is_first_rank;
    std::ofstream file;
    std::string   before_open;

    void
    write_to_file(const std::string &text);
  };
} // namespace fiberloom

#endif
