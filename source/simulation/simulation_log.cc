// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// What a run says of itself at its start and end.

#include <fiberloom/base/version.h>

#include <fiberloom/simulation/simulation.h>

#include <deal.II/base/mpi.h>

#include <boost/format.hpp>

#include <filesystem>

namespace fiberloom
{
  void
  Simulation::log_header()
  {
    const ModelSize size = expected_size();
    std::string     stages;
    for (const std::string &stage : parameters.stages)
      stages += (stages.empty() ? "" : ", ") + stage;
    const std::string plies =
      fibers.n_plies() > 1 ?
        " in " + std::to_string(fibers.n_plies()) + " plies" :
        "";
    log.write(
      (boost::format("fiberloom %s  %s: %s of %u fibers%s, %u dofs, on "
                     "%u %s") %
       program_version() % command_line.file % stages % size.fibers % plies %
       (size.fiber_dofs + size.matrix_dofs) %
       dealii::Utilities::MPI::n_mpi_processes(comm) %
       (dealii::Utilities::MPI::n_mpi_processes(comm) == 1 ? "rank" : "ranks"))
        .str());
  }



  void
  Simulation::log_what_is_left_out()
  {
    std::string left_out;
    if (parameters.contact.friction_coefficient == 0)
      left_out += " friction and its history,";
    if (!generator.searches())
      left_out += " the search for contact,";
    if (!parameters.has_matrix())
      left_out += " matrix layers, junctions,";
    if (parameters.output.only_summary)
      left_out += " all files but log.txt and summary.json,";
    if (left_out.empty())
      return;
    left_out.back() = ' ';
    log.write("left out, as the scene does not need it:" +
              left_out.substr(0, left_out.size() - 1));
  }



  void
  Simulation::log_timings(const std::vector<StageStatistics> &stages)
  {
    log.write((boost::format("%-9s %13s %13s %13s %13s %13s %13s %13s") %
               "stage" % "detection" % "assembly" % "analysis" %
               "factorization" % "krylov" % "output" % "all [s]")
                .str());
    for (const StageStatistics &stage : stages)
      {
        const Seconds &s = stage.seconds;
        log.write((boost::format("%-9s %13.2f %13.2f %13.2f %13.2f %13.2f "
                                 "%13.2f %13.2f") %
                   stage.name % s.detection % s.assembly % s.analysis %
                   s.factorization % s.krylov % s.output % s.wall)
                    .str());
      }
  }



  void
  Simulation::log_benchmark(const std::vector<StageStatistics> &stages)
  {
    for (const StageStatistics &stage : stages)
      if (const Seconds &s = stage.seconds; s.yardstick > 0)
        {
          const double all = s.detection + s.assembly + s.linear_solver;
          log.write((boost::format(
                       "%-9s %u Newton iterations, %u factorisations; one "
                       "symmetric double factorisation: %.2f s on %u ranks; a "
                       "Newton iteration: %.2f of it; detection and assembly: "
                       "%.1f %%") %
                     stage.name % stage.newton_iterations %
                     stage.factorizations % s.yardstick %
                     dealii::Utilities::MPI::n_mpi_processes(comm) %
                     (all / stage.newton_iterations / s.yardstick) %
                     (100 * (s.detection + s.assembly) / all))
                      .str());
        }
  }



  void
  Simulation::log_results()
  {
    const std::string &directory = parameters.output_directory;
    std::error_code    unreadable;
    const std::string  fields =
      std::filesystem::exists(directory + "/fibers.pvd", unreadable) ?
         ".pvd files for ParaView, " :
         "";
    log.write("results in " + directory + ": " +
              (parameters.output.only_summary ?
                 "summary.json" :
                 "report.html for a first look, " + fields +
                   "loading_curve.csv, summary.json"));
  }
} // namespace fiberloom
