// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_simulation_read_input_h
#define fiberloom_simulation_read_input_h

#include <fiberloom/base/command_line.h>
#include <fiberloom/base/parameters.h>

#include <mpi.h>

namespace fiberloom
{
  /**
   * The parameters in force: file and overrides, automatic values resolved,
   * everything checked that does not need a restart file. Throws the same
   * InputError on every rank.
   */
  Parameters
  read_input(const CommandLine &command_line, const MPI_Comm comm);

  /**
   * Answers on the screen what needs no simulation: help, version, parameters
   * and their reference. Returns whether that was asked for. Throws the same
   * InputError on every rank.
   */
  bool
  answer_question(const CommandLine &command_line, const MPI_Comm comm);
} // namespace fiberloom

#endif
