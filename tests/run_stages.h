// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_tests_run_stages_h
#define fiberloom_tests_run_stages_h

#include <fiberloom/stages/coat.h>

#include <fiberloom/simulation/stage_run.h>

#include <deal.II/base/exceptions.h>

/** Runs the stages of @p parameters on @p fibers , without any file. */
inline void
run_stages(const fiberloom::Parameters        &parameters,
           const fiberloom::FiberSet          &fibers,
           const fiberloom::IncrementObserver &observer)
{
  using namespace fiberloom;
  const FiberMesh  mesh(fibers);
  ContactGenerator generator(fibers, mesh, parameters.contact, MPI_COMM_WORLD);
  Log              log(MPI_COMM_WORLD);
  State            state;
  state.q = mesh.reference();
  std::unique_ptr<Composite> composite;
  for (const std::string &name : parameters.stages)
    {
      if (stage_type(name).adds_matrix)
        {
          add_matrix(parameters, mesh, state);
          composite = std::make_unique<Composite>(state.matrix, mesh);
        }
      const Scene scene{parameters, fibers, mesh, composite.get()};
      const auto  stage = create_stage(name, scene);
      const auto  planned =
        stage->n_increments(state, 0, stage->first_step(state));
      StageStatistics statistics;
      statistics.name = name;
      StageRun(scene,
               *stage,
               {generator, log, MPI_COMM_WORLD, []() { return false; }},
               statistics,
               state)
        .run(state, observer);
      AssertThrow(!stage->is_test() || statistics.rejected_increments > 0 ||
                    statistics.increments == planned,
                  dealii::ExcMessage("other increments than were planned"));
      state.begin_stage(state.stage + 1);
    }
}

#endif
