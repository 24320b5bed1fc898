// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/command_line.h>
#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/exit_guard.h>

#include <fiberloom/simulation/read_input.h>
#include <fiberloom/simulation/simulation.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <csignal>
#include <iostream>

// Of OpenBLAS, where that is the BLAS.
extern "C" void
openblas_set_num_threads(int) __attribute__((weak));

int
main(int argc, char *argv[])
{
  using namespace fiberloom;
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  // Ranks are the parallelism: with threads of its own each would be slower.
  if (openblas_set_num_threads)
    openblas_set_num_threads(1);
  // A screen or a disk that takes no more is told by what is written there.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  dealii::deal_II_exceptions::disable_abort_on_exception();
  dealii::deal_II_exceptions::suppress_stacktrace_in_exceptions();

  const ExitGuard guard;
  const MPI_Comm  comm = MPI_COMM_WORLD;
  const bool is_first  = dealii::Utilities::MPI::this_mpi_process(comm) == 0;
  try
    {
      const CommandLine command_line = CommandLine::parse(argc, argv);
      if (answer_question(command_line, comm))
        return 0;
      const Parameters parameters = read_input(command_line, comm);
      return Simulation(parameters, command_line, comm).run();
    }
  catch (const InputError &error) // the same on every rank
    {
      if (is_first)
        std::cerr << "fiberloom: " << one_line(error) << std::endl;
      return 1;
    }
  catch (const StageFailure &error) // the same on every rank
    {
      if (is_first)
        std::cerr << "fiberloom: " << one_line(error) << std::endl;
      return 2;
    }
  catch (const std::exception &error)
    {
      std::cerr << "fiberloom: " << one_line(error) << std::endl;
      if (dealii::Utilities::MPI::n_mpi_processes(comm) > 1)
        PMPI_Abort(comm, 2); // other ranks may wait for this one
      return 2;
    }
}
