// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// A call of exit() in the middle of things has status 2, and its own where
// there is no guard or none any more.

#include <fiberloom/base/exit_guard.h>

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

using namespace fiberloom;

namespace
{
  /** Of a child that is given its own status 255 by a library. */
  int
  status(void (*work)())
  {
    const pid_t child = fork();
    if (child == 0)
      {
        work();
        std::exit(-1);
      }
    int status = 0;
    waitpid(child, &status, 0);
    return WEXITSTATUS(status);
  }
} // namespace

int
main()
{
  std::ofstream out("output");
  out << "without " << status([]() {}) << std::endl;
  out << "guarded " << status([]() {
    const ExitGuard guard;
    std::exit(-1);
  }) << std::endl;
  out << "not any more " << status([]() { const ExitGuard guard; })
      << std::endl;
  out << "and again " << status([]() {
    {
      const ExitGuard guard;
    }
    const ExitGuard guard;
    std::exit(0);
  }) << std::endl;
}
