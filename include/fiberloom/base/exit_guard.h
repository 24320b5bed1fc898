// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_base_exit_guard_h
#define fiberloom_base_exit_guard_h

namespace fiberloom
{
  /**
   * While one lives, a library that calls exit(), as linear solvers do when
   * they cannot allocate, ends the program with a line of its own and status 2
   * in place of whatever status that library has chosen.
   */
  class ExitGuard
  {
  public:
    ExitGuard();

    ~ExitGuard();

    ExitGuard(const ExitGuard &) = delete;

    ExitGuard &
    operator=(const ExitGuard &) = delete;
  };
} // namespace fiberloom

#endif
