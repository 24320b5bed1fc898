// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// What is asked for decides what is spent, not what is found: a small weave is
// pulled with a loose tolerance by fewer linear systems than there are contact
// updates, and with the forces of a run whose tolerance is much tighter.

#include <fiberloom/fabric/fabric_parameters.h>

#include <deal.II/base/mpi.h>

#include <fstream>

#include "checks.h"
#include "run_stages.h"

using namespace fiberloom;

namespace
{
  struct Ended
  {
    double          force = 0; // across the warp tows
    StageStatistics spent;     // in the last stage
  };

  Ended
  run_small_weave(const std::vector<std::string> &settings)
  {
    Parameters parameters =
      Parameters::parse(SOURCE_DIR "/scenes/small_weave.prm", settings);
    resolve_fabric(parameters);
    Ended ended;
    run_stages(parameters,
               build_fiber_set(parameters),
               [&](const IncrementReport &report) {
                 for (const auto &[column, value] : report.curve)
                   if (column.name == "force_fill")
                     ended.force = value;
                 ended.spent = report.statistics;
               });
    return ended;
  }

  void
  check_loose_newton(Checks &checks)
  {
    const Ended loose = run_small_weave({"Solver/Contact tolerance=0.02"});
    const Ended tight = run_small_weave({"Solver/Contact tolerance=1e-3"});
    checks.above("force", tight.force, .1);
    checks.below("loose force against tight",
                 loose.force / tight.force - 1,
                 1e-2);
    checks.below("Newton iterations per pass",
                 double(loose.spent.newton_iterations) /
                   (loose.spent.contact_updates + loose.spent.normal_updates),
                 1);
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::ofstream                            output("output");
  Checks                                   checks(output);

  check_loose_newton(checks);
}
