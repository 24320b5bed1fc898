// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_files_h
#define fiberloom_output_files_h

#include <mpi.h>

#include <functional>
#include <string>

namespace fiberloom
{
  /** What a file waits for before it takes the place of another. */
  enum class Durability
  {
    none,
    on_disk
  };

  /**
   * Writes @p content beside @p file and renames it, so that a reader finds
   * either the old file or the whole new one, and in place of a link or a pipe
   * of this name. Throws StageFailure with the system's reason and leaves the
   * old file as it was.
   */
  void
  write_file(const std::string &file,
             const std::string &content,
             const Durability   durability = Durability::none);

  /**
   * Gives @p file the name @p to , in place of what had it. Throws
   * StageFailure.
   */
  void
  rename_file(const std::string &file,
              const std::string &to,
              const Durability   durability = Durability::none);

  /** Throws InputError when @p file cannot be read. */
  std::string
  read_file(const std::string &file);

  /**
   * Runs @p work on every rank; when it throws on one of them, all ranks throw
   * StageFailure with the message of the first, so that none waits for ever.
   */
  void
  collectively(const MPI_Comm comm, const std::function<void()> &work);
} // namespace fiberloom

#endif
