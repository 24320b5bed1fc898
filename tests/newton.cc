// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// Newton's method on the incremental potential: a small weave comes to rest,
// and a pull of it, to any tolerance. The end is quadratic, so that a
// tolerance ten thousand times tighter costs hardly more iterations, and the
// forces do not depend on when the method stops.

#include <fiberloom/fabric/fabric_parameters.h>

#include <deal.II/base/mpi.h>

#include <fstream>
#include <map>

#include "checks.h"
#include "run_stages.h"

using namespace fiberloom;

namespace
{
  struct Ended
  {
    double       force      = 0;
    double       thickness  = 0;
    unsigned int iterations = 0, increments = 0, out_of_order = 0;
  };

  Ended
  run_small_weave(const std::vector<std::string> &more)
  {
    std::vector<std::string> settings{"Stages=weave, relax, biaxial",
                                      "Solver/Loops=newton",
                                      "Biaxial/First step=1",
                                      "Biaxial/Largest step=1"};
    settings.insert(settings.end(), more.begin(), more.end());
    Parameters parameters =
      Parameters::parse(SOURCE_DIR "/scenes/small_weave.prm", settings);
    resolve_fabric(parameters);
    Ended                               ended;
    std::map<std::string, unsigned int> iterations;
    run_stages(parameters,
               build_fiber_set(parameters),
               [&](const IncrementReport &report) {
                 for (const auto &[column, value] : report.curve)
                   {
                     if (column.name == "force_warp")
                       ended.force = value;
                     if (column.name == "thickness")
                       ended.thickness = value;
                   }
                 iterations[report.stage] = report.statistics.newton_iterations;
                 ended.increments += report.statistics.increments;
                 ended.out_of_order = report.statistics.crossings_out_of_order;
               });
    for (const auto &[stage, n] : iterations)
      ended.iterations += n;
    return ended;
  }
} // namespace



int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::ofstream                            output;
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    output.open("output");
  Checks checks(output);

  const Ended usual = run_small_weave({"Solver/Contact tolerance=1e-4"});
  const Ended tight = run_small_weave({"Solver/Contact tolerance=1e-8"});
  checks.above("force", usual.force, .1);
  checks.equal("crossings out of order", usual.out_of_order, 0);
  checks.equal("increments", usual.increments, 3);
  checks.below("force against that of the tighter tolerance",
               usual.force / tight.force - 1,
               1e-4);
  checks.below("thickness against that of the tighter tolerance",
               usual.thickness / tight.thickness - 1,
               1e-4);
  checks.above("iterations", usual.iterations, 1);
  checks.below("iterations to the tighter tolerance, over these",
               double(tight.iterations) / usual.iterations,
               1.35);
}
