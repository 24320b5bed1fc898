// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// The whole program in a child for each line of input, which holds its
// arguments with tabs between, in the working directory and with the files
// `out` and `err` beside it. Answers a line each: "exit 1" or "signal 11".
// What a start costs, some 200 libraries and MPI, is paid once.
//
//     fork_server SECONDS MEGABYTES

#include <deal.II/base/mpi.h>

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace dealii::Utilities::MPI
{
  /** In place of the one in main(): the server has started MPI. */
  struct Started
  {
    Started(int &, char **&, unsigned int)
    {}
  };
} // namespace dealii::Utilities::MPI

#define main run_program
#define MPI_InitFinalize Started
#include "../../source/main.cc"
#undef MPI_InitFinalize
#undef main

#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

namespace
{
  void
  limit(const int resource, const rlim_t most)
  {
    const rlimit limits = {most, most};
    if (setrlimit(resource, &limits) != 0)
      std::abort();
  }

  void
  write_to(const char *file, const int descriptor)
  {
    const int opened = open(file, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (opened < 0 || dup2(opened, descriptor) < 0)
      std::abort();
    close(opened);
  }

  [[noreturn]] void
  run_child(const std::string &line, const int seconds, const int megabytes)
  {
    write_to("/dev/null", STDIN_FILENO);
    write_to("../out", STDOUT_FILENO);
    write_to("../err", STDERR_FILENO);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, seconds);
#ifdef __SANITIZE_ADDRESS__ // it maps terabytes
    (void)megabytes;
#else
    limit(RLIMIT_AS, rlim_t(megabytes) << 20);
#endif
    alarm(10 * seconds); // what waits takes no time of the processor

    std::vector<std::string> words = {"fiberloom"};
    std::istringstream       in(line);
    for (std::string word; std::getline(in, word, '\t');)
      words.push_back(word);
    std::vector<char *> arguments;
    for (std::string &word : words)
      arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const int status = run_program(words.size(), arguments.data());
    std::cout.flush();
    std::fflush(nullptr);
    _exit(status); // what the server started is not the child's to end
  }
} // namespace

int
main(int argc, char *argv[])
{
  if (argc != 3)
    return 1;
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (std::string line; std::getline(std::cin, line);)
    {
      const pid_t child = fork();
      if (child == 0)
        run_child(line, std::atoi(argv[1]), std::atoi(argv[2]));
      int status = 0;
      if (child < 0 || waitpid(child, &status, 0) != child)
        return 1;
      if (WIFEXITED(status))
        std::cout << "exit " << WEXITSTATUS(status) << std::endl;
      else
        std::cout << "signal " << WTERMSIG(status) << std::endl;
    }
}
