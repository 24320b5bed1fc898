// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// A weave that starts on fewer elements ends at the same thickness and at no
// higher energy than one that does not, in balance and in order, with less
// work on its own mesh; where as few elements as show the crossings would save
// little, it starts on its own.

#include <fiberloom/fabric/fabric_parameters.h>

#include <deal.II/base/mpi.h>

#include <fstream>

#include "checks.h"
#include "run_stages.h"

using namespace fiberloom;

namespace
{
  struct Woven
  {
    double          thickness = 0; // [mm]
    StageStatistics weave;
  };

  Woven
  weave(const std::vector<std::string> &settings)
  {
    Parameters parameters =
      Parameters::parse(SOURCE_DIR "/scenes/small_weave.prm", settings);
    parameters.stages = {"weave", "relax"};
    resolve_fabric(parameters);
    Woven woven;
    run_stages(parameters,
               build_fiber_set(parameters),
               [&](const IncrementReport &report) {
                 if (report.stage == "weave")
                   woven.weave = report.statistics;
                 else
                   woven.thickness = report.curve.front().second;
               });
    return woven;
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::ofstream                            output("output");
  Checks                                   checks(output);

  // The warp's 15 elements become 8, so that nodes do not lie on nodes.
  const std::vector<std::string> elements{"Fabric/Warp/Elements per fiber=15",
                                          "Fabric/Fill/Same as warp=false",
                                          "Fabric/Fill/Elements per fiber=14"};
  auto                           settings = elements;
  settings.push_back("Weaving/Coarser meshes=0");
  const Woven fine = weave(settings), coarse = weave(elements);
  checks.equal("iterations on coarser meshes, without",
               fine.weave.coarse_iterations,
               0);
  checks.above("iterations on coarser meshes",
               coarse.weave.coarse_iterations,
               10);
  checks.below("on its own mesh, over those without",
               double(coarse.weave.newton_iterations) /
                 fine.weave.newton_iterations,
               .5);
  checks.equal("out of order", coarse.weave.crossings_out_of_order, 0);
  checks.above("thickness [mm]", fine.thickness, .02);
  checks.below("difference of thickness",
               std::abs(coarse.thickness / fine.thickness - 1),
               .01);
  checks.below("energy over that without",
               coarse.weave.elastic_energy / fine.weave.elastic_energy,
               1.01);

  const Woven few = weave({"Fabric/Warp/Elements per fiber=5"});
  checks.equal("of so few that fewer would save little",
               few.weave.coarse_iterations,
               0);
}
