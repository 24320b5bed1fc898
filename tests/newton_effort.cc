// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// What keeps Newton iterations few. The inner loop is as loose as the outer
// loops allow: a small weave is pulled with fewer linear systems than there are
// passes of the outer loops, and with the forces of a run whose tolerance is
// much tighter. The line search keeps contacts from opening and closing in
// turn: without it weaving with friction by the nested loops takes more
// iterations. By how much depends on the steps (1.1 to 1.8 times for 0.5 to 2
// r), so three of them count.

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
    double          force = 0; // the last column of the loading curve
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
                 ended.force = report.curve.back().second;
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

  unsigned int
  iterations_of_weaving(const std::string &line_search_from)
  {
    unsigned int iterations = 0;
    for (const char *step : {"0.5", "0.75", "1.5"})
      iterations +=
        run_small_weave({"Stages=weave",
                         "Weaving/Path=nested",
                         "Weaving/Step=" + std::string(step),
                         "Solver/Line search from=" + line_search_from})
          .spent.newton_iterations;
    return iterations;
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::ofstream                            output("output");
  Checks                                   checks(output);

  check_loose_newton(checks);
  const std::string by_default =
    std::to_string(SolverParameters().line_search_from);
  checks.above("Newton iterations without the line search over those with it",
               double(iterations_of_weaving("1000")) /
                 iterations_of_weaving(by_default),
               1.2);
}
