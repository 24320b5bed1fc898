// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/version.h>

#include <fiberloom/fabric/fabric_parameters.h>

#include <fiberloom/simulation/read_input.h>

#include <deal.II/base/mpi.h>

#include <iostream>
#include <sstream>

namespace fiberloom
{
  namespace
  {
    Parameters
    read_on_this_rank(const CommandLine &command_line)
    {
      Parameters parameters =
        Parameters::parse(command_line.file, command_line.overrides);
      resolve_fabric(parameters);
      if (command_line.restart.empty())
        parameters.check_stage_order({}, 0);
      return parameters;
    }

    void
    print_parameters(const CommandLine &command_line,
                     const MPI_Comm     comm,
                     std::ostream      &out)
    {
      if (!command_line.file.empty())
        read_input(command_line, comm).print(out);
      else if (command_line.overrides.empty())
        Parameters().print(out);
      else
        throw InputError("command line: --set and --output-directory need a "
                         "parameter file");
    }
  } // namespace

  Parameters
  read_input(const CommandLine &command_line, const MPI_Comm comm)
  {
    Parameters  parameters;
    std::string error;
    try
      {
        parameters = read_on_this_rank(command_line);
      }
    catch (const InputError &input_error)
      {
        error = one_line(input_error);
      }
    // a rank that cannot read the file must not leave the others waiting
    for (const std::string &text :
         dealii::Utilities::MPI::all_gather(comm, error))
      if (!text.empty())
        throw InputError(text);
    return parameters;
  }

  bool
  answer_question(const CommandLine &command_line, const MPI_Comm comm)
  {
    std::ostringstream answer;
    if (command_line.help)
      CommandLine::print_help(answer);
    else if (command_line.version)
      answer << version_text();
    else if (command_line.print_reference)
      Parameters::print_reference(answer);
    else if (command_line.print_parameters)
      print_parameters(command_line, comm, answer);
    else
      return false;

    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      std::cout << answer.str() << std::flush;
    return true;
  }
} // namespace fiberloom
