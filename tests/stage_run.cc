// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// An increment that cannot be shown is taken back, with its statistics, and
// taken again by a run that goes on from there.

#include <fiberloom/base/exceptions.h>

#include <fiberloom/fabric/fabric_parameters.h>

#include <fiberloom/simulation/stage_run.h>

#include <deal.II/base/mpi.h>

#include <fstream>

#include "checks.h"

using namespace fiberloom;

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::ofstream                            output("output");
  Checks                                   checks(output);

  Parameters parameters =
    Parameters::parse(SOURCE_DIR "/../prm/cantilever.prm", {});
  resolve_fabric(parameters);
  const FiberSet   fibers = build_fiber_set(parameters);
  const FiberMesh  mesh(fibers);
  const Scene      scene{parameters, fibers, mesh, nullptr};
  ContactGenerator generator(fibers, mesh, parameters.contact, MPI_COMM_WORLD);
  Log              log(MPI_COMM_WORLD);
  const RunContext context{generator, log, MPI_COMM_WORLD, []() {
                             return false;
                           }};
  const auto       stage = create_stage(parameters.stages[0], scene);
  State            state;
  StageStatistics  statistics;
  statistics.name     = parameters.stages[0];
  state.q             = mesh.reference();
  double       shown  = 0; // this load
  unsigned int n      = 0; // increments
  bool         failed = false;
  try
    {
      StageRun(scene, *stage, context, statistics, state)
        .run(state, [&](const IncrementReport &report) {
          if (report.last)
            throw StageFailure("the disk is full");
          shown = report.state.load;
          n     = report.state.increment;
        });
    }
  catch (const StageFailure &)
    {
      failed = true;
    }
  checks.that("the run fails", failed);
  checks.above("increments that are shown", n, 1);
  checks.that("the state is the one shown last", state.load == shown);
  checks.that("with its increments", statistics.increments == n);

  bool ended = false;
  StageRun(scene, *stage, context, statistics, state)
    .run(state, [&](const IncrementReport &report) { ended = report.last; });
  checks.that("going on, the last one is shown", ended);
  checks.that("with one more increment", state.increment == n + 1);
}
