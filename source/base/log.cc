// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/log.h>

#include <iostream>

namespace fiberloom
{
  Log::Log(const MPI_Comm comm)
    : is_first_rank(dealii::Utilities::MPI::this_mpi_process(comm) == 0)
  {}

  void
  Log::open(const std::string &directory, const bool append)
  {
    if (!is_first_rank)
      return;
    file.open(directory + "/log.txt", append ? std::ios::app : std::ios::trunc);
    write_to_file(before_open);
    before_open.clear();
  }

  void
  Log::write(const std::string &text)
  {
    if (!is_first_rank)
      return;
    const std::string lines =
      text.empty() || text.back() != '\n' ? text + '\n' : text;
    std::cout << lines << std::flush;
    if (file.is_open())
      write_to_file(lines);
    else
      before_open += lines;
  }

  void
  Log::write_to_file(const std::string &text)
  {
    // a log that cannot be written is no reason to lose the run; it goes on
    // as soon as there is room
    if (!(file << text << std::flush))
      {
        std::cout << "log.txt cannot be written" << std::endl;
        file.clear();
      }
  }
} // namespace fiberloom
