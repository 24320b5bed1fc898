// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// The inner Newton loop is as loose as the outer loops allow: a small weave is
// pulled with fewer linear systems than there are passes of the outer loops,
// and with the forces of a run whose tolerance is much tighter.

#include <fiberloom/fabric/fabric_parameters.h>

#include <deal.II/base/mpi.h>

#include <fstream>

#include "checks.h"
#include "run_stages.h"

using namespace fiberloom;

namespace
{
  struct Pulled
  {
    double force = 0, newton_per_pass = 0;
  };

  Pulled
  pull(const std::string &tolerance)
  {
    Parameters parameters =
      Parameters::parse(SOURCE_DIR "/scenes/small_weave.prm",
                        {"Solver/Contact tolerance=" + tolerance});
    resolve_fabric(parameters);
    Pulled pulled;
    run_stages(parameters,
               build_fiber_set(parameters),
               [&](const IncrementReport &report) {
                 if (report.stage != "biaxial")
                   return;
                 const StageStatistics &spent = report.statistics;
                 pulled.force                 = report.curve.back().second;
                 pulled.newton_per_pass =
                   double(spent.newton_iterations) /
                   (spent.contact_updates + spent.normal_updates);
               });
    return pulled;
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::ofstream                            output("output");
  Checks                                   checks(output);

  const Pulled loose = pull("0.02"), tight = pull("1e-5");
  checks.above("force", tight.force, .1);
  checks.below("loose force against tight",
               loose.force / tight.force - 1,
               1e-2);
  checks.below("Newton iterations per pass", loose.newton_per_pass, 1);
}
