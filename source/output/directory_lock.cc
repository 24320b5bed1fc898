// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>

#include <fiberloom/output/directory_lock.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

namespace fiberloom
{
  namespace
  {
    /** What the run that has the lock says of itself. */
    std::string
    owner(const FileDescriptor &file)
    {
      char       text[200];
      const auto n = ::pread(file.number(), text, sizeof(text), 0);
      for (ssize_t i = 0; i < n; ++i)
        if (text[i] < ' ' || text[i] > '~')
          return i > 0 ? std::string(text, i) : "another run";
      return "another run";
    }

    void
    sign(FileDescriptor &file)
    {
      try
        {
          if (::ftruncate(file.number(), 0) == 0)
            file.write("process " + std::to_string(::getpid()) + " on " +
                       dealii::Utilities::System::get_hostname() + "\n");
        }
      catch (const StageFailure &)
        {
          // A full disk: the lock holds all the same.
        }
    }
  } // namespace



  DirectoryLock::DirectoryLock(const std::string &directory,
                               const MPI_Comm     comm)
    : name(directory + "/lock")
  {
    using namespace dealii::Utilities::MPI;

    std::string reason;
    if (this_mpi_process(comm) == 0)
      try
        {
          reason = take(directory);
        }
      catch (const std::exception &error)
        {
          reason = error.what();
        }
    reason = broadcast(comm, reason, 0);
    if (!reason.empty())
      throw InputError("Output directory: " + directory + " is no use (" +
                       reason +
                       "); allowed is a directory that exists or can be "
                       "created, and that no other run has");
    locked = broadcast(comm, locked, 0);
  }



  DirectoryLock::~DirectoryLock()
  {
    // Removed while it is locked: nobody else can have it yet.
    if (file && locked)
      ::unlink(name.c_str());
  }



  std::string
  DirectoryLock::take(const std::string &directory)
  {
    std::error_code error;
    std::filesystem::create_directories(directory, error);
    if (error)
      return error.message();
    do
      {
        file = std::make_unique<FileDescriptor>(name, O_RDWR | O_CREAT);
        if (!file->is_regular())
          return name + " is not a file";
        locked = ::flock(file->number(), LOCK_EX | LOCK_NB) == 0;
        if (!locked && errno == EWOULDBLOCK)
          return "in use by " + owner(*file);
      }
    while (locked && !is_current(*file));
    sign(*file);
    return "";
  }



  bool
  DirectoryLock::is_current(const FileDescriptor &opened) const
  {
    struct stat mine, current;
    return ::fstat(opened.number(), &mine) == 0 &&
           ::lstat(name.c_str(), &current) == 0 &&
           mine.st_dev == current.st_dev && mine.st_ino == current.st_ino;
  }
} // namespace fiberloom
