// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_directory_lock_h
#define fiberloom_output_directory_lock_h

#include <fiberloom/base/file_descriptor.h>

#include <mpi.h>

#include <memory>
#include <string>

namespace fiberloom
{
  /**
   * While one lives no other run can have the same output directory. Rank 0
   * locks a file "lock" there, which says which process it is; the lock ends
   * with the process, however that ends, and a file that a killed run has left
   * locks nothing.
   */
  class DirectoryLock
  {
  public:
    /**
     * Creates @p directory with its parents. Throws InputError on every rank
     * when that fails, when nothing can be written there, or when another run
     * has it. Collective.
     */
    DirectoryLock(const std::string &directory, const MPI_Comm comm);

    /** Removes the file. */
    ~DirectoryLock();

    /** Whether the file system can lock; the same on every rank. */
    bool
    holds() const
    {
      return locked;
    }

  private:
    /** Why the directory is no use; empty if it is. */
    std::string
    take(const std::string &directory);

    /** Whether @p opened is still what has the name, and not removed by the
     * run that had the lock before. */
    bool
    is_current(const FileDescriptor &opened) const;

    const std::string               name;
    std::unique_ptr<FileDescriptor> file; // on rank 0
    bool                            locked = true;
  };
} // namespace fiberloom

#endif
