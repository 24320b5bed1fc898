// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>

#include <fiberloom/simulation/coarse_start.h>
#include <fiberloom/simulation/refinement.h>
#include <fiberloom/simulation/stage_run.h>

#include <boost/format.hpp>

namespace fiberloom
{
  namespace
  {
    // Of a fiber for each tow that it crosses: a quadratic element has one
    // half wave.
    constexpr unsigned int least_elements = 2;

    // Contact, too, is coarser: it needs fewer stations, and what touches
    // changes less abruptly.
    constexpr double softer = 4, looser = 10;

    /** Half as many elements, and softer contact; whether the scene allows it.
     */
    bool
    coarsen(Parameters &parameters)
    {
      FabricParameters &fabric = parameters.fabric;
      if (!parameters.is_fabric() || parameters.weaving.coarser_meshes == 0 ||
          parameters.weaving.path == "nested" ||
          parameters.solver.loops == "nested")
        return false;
      --parameters.weaving.coarser_meshes;
      // Where a fabric comes to rest does not depend on friction.
      parameters.contact.friction_coefficient = 0;
      parameters.contact.largest_penetration *= softer;
      parameters.contact.initial_stiffness /= softer;
      parameters.contact.line_stiffness /= softer;
      parameters.solver.contact_tolerance *= looser;
      const auto halve = [](TowParameters &tows, const unsigned int crossed) {
        tows.elements_per_fiber = (tows.elements_per_fiber + 1) / 2;
        return tows.elements_per_fiber >= least_elements * crossed;
      };
      const bool warp = halve(fabric.warp, fabric.fill.tows),
                 fill = halve(fabric.fill, fabric.warp.tows);
      return warp && fill;
    }

    void
    add_cost(const StageStatistics &coarse, StageStatistics &statistics)
    {
      statistics.coarse_iterations +=
        coarse.newton_iterations + coarse.coarse_iterations;
      statistics.seconds.detection += coarse.seconds.detection;
      statistics.seconds.assembly += coarse.seconds.assembly;
      statistics.seconds.linear_solver += coarse.seconds.linear_solver;
      statistics.seconds.analysis += coarse.seconds.analysis;
      statistics.seconds.factorization += coarse.seconds.factorization;
      statistics.seconds.krylov += coarse.seconds.krylov;
    }
  } // namespace



  std::optional<State>
  start_coarsely(const Scene                 &scene,
                 const std::string           &name,
                 StageStatistics             &statistics,
                 Log                         &log,
                 const MPI_Comm               comm,
                 const std::function<bool()> &stop_requested)
  {
    Parameters parameters = scene.parameters;
    if (!coarsen(parameters))
      return {};
    const FiberSet  fibers = build_fiber_set(parameters);
    const FiberMesh mesh(fibers);
    const Scene     coarse{parameters, fibers, mesh};
    log.write(
      (boost::format("  %-6s on %u elements first") % name % mesh.n_elements())
        .str());

    StageStatistics  cost;
    ContactGenerator generator(fibers, mesh, parameters.contact, comm);
    const auto       stage = create_stage(name, coarse);
    State            state;
    state.q = mesh.initial();
    try
      {
        StageRun run(coarse,
                     *stage,
                     name,
                     generator,
                     cost,
                     log,
                     comm,
                     stop_requested,
                     state);
        run.run(state, [](const IncrementReport &) {});
      }
    catch (const StageFailure &)
      {
        add_cost(cost, statistics);
        return {};
      }
    add_cost(cost, statistics);
    const Refinement finer{2, 2, softer};
    return Transfer(coarse, state.matrix, scene.mesh, finer)(state);
  }
} // namespace fiberloom
