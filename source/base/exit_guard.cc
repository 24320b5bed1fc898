// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exit_guard.h>

#include <mpi.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

namespace fiberloom
{
  namespace
  {
    bool guarded = false;

    constexpr int failed = 2;

    void
    explain()
    {
      std::fflush(nullptr);
      std::fputs("fiberloom: a library has ended the program, perhaps for want "
                 "of memory; the last checkpoint is intact\n",
                 stderr);
    }

    void
    end_guarded()
    {
      if (!guarded)
        return;
      explain();
      ::_exit(failed);
    }
  } // namespace

  ExitGuard::ExitGuard()
  {
    static const int registered = std::atexit(end_guarded);
    guarded                     = registered == 0;
  }

  ExitGuard::~ExitGuard()
  {
    guarded = false;
  }



  namespace
  {
    int
    abort_guarded(const MPI_Comm comm, const int status)
    {
      if (!guarded)
        return PMPI_Abort(comm, status);
      explain();
      guarded = false; // PMPI_Abort() may call exit()
      return PMPI_Abort(comm, failed);
    }
  } // namespace
} // namespace fiberloom



/** In place of MPI's own, as MPI lets a program have it. */
extern "C" int
MPI_Abort(MPI_Comm comm, int status)
{
  return fiberloom::abort_guarded(comm, status);
}
