// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/stages/weave.h>

#include <fiberloom/simulation/coarse_start.h>
#include <fiberloom/simulation/refinement.h>

#include <boost/format.hpp>

#include <algorithm>

namespace fiberloom
{
  namespace
  {
    // Contact, too, is coarser: it needs fewer stations, and what touches
    // changes less abruptly. Deeper than this, over the radius, fibers would
    // no longer stay on their sides.
    constexpr double softer = 4, deepest = .5;

    // Where a step would gain less than this part of the energy, the finer mesh
    // goes on: it changes the energy by a hundredth.
    constexpr double near_enough = 1e-5;

    // Of the iterations of a mesh the next one takes about this part: a tenth
    // in small samples, as many in large ones.
    constexpr double iterations_of_next = .5;

    // A coarser mesh pays if it has no more than this part of the elements.
    constexpr double coarser = .75;

    /** Half as many elements, but enough to show each crossing, and softer
     * contact; whether that pays. */
    bool
    coarsen(Parameters &parameters)
    {
      WeaveSettings &weaving = parameters.stage_settings.get<WeaveSettings>();
      --weaving.coarser_meshes;
      ContactParameters &contact = parameters.contact;
      const double       part =
        std::clamp(deepest / contact.largest_penetration, 1., softer);
      contact.largest_penetration *= part;
      contact.initial_stiffness /= part;
      contact.line_stiffness /= part;
      // Where a fabric comes to rest does not depend on friction.
      contact.friction_coefficient = 0;
      weaving.near_enough          = near_enough;
      FabricParameters &fabric     = parameters.fabric;
      const auto halve = [](TowParameters &tows, const unsigned int crossed) {
        const unsigned int before = tows.elements_per_fiber;
        tows.elements_per_fiber =
          std::max((before + 1) / 2, TowParameters::least_elements * crossed);
        return tows.elements_per_fiber <= coarser * before;
      };
      const bool warp = halve(fabric.warp, fabric.fill.tows),
                 fill = halve(fabric.fill, fabric.warp.tows);
      return parameters.is_fabric() && warp && fill;
    }
  } // namespace



  std::optional<State>
  start_coarsely(const Scene      &scene,
                 const RunContext &context,
                 StageStatistics  &statistics)
  {
    Parameters parameters = scene.parameters;
    if (!coarsen(parameters))
      return {};
    const FiberSet     fibers = build_fiber_set(parameters);
    const FiberMesh    mesh(fibers);
    const Scene        coarse{parameters, fibers, mesh};
    const std::string &name = statistics.name;
    context.log.write(
      (boost::format("  %-6s on %u elements first") % name % mesh.n_elements())
        .str());

    StageStatistics cost;
    cost.name = name;
    ContactGenerator generator(fibers, mesh, parameters.contact, context.comm);
    const auto       stage = create_stage(name, coarse);
    State            state;
    state.q = mesh.initial();
    StageRun   run(coarse,
                 *stage,
                 {generator, context.log, context.comm, context.stop_requested},
                 cost,
                 state);
    const bool arrived = run.run_fast(state);
    statistics.coarse_iterations +=
      cost.newton_iterations + cost.coarse_iterations;
    statistics.seconds.coarse += cost.seconds.wall;
    const double seconds = cost.seconds.wall - cost.seconds.coarse;
    const double larger =
      static_cast<double>(scene.mesh.n_elements()) / mesh.n_elements();
    std::string line =
      (boost::format("  %-6s on %u elements %s after %u iterations, %.0f s") %
       name % mesh.n_elements() %
       (arrived ? "comes to rest" : "does not come to rest") %
       cost.newton_iterations % seconds)
        .str();
    if (arrived)
      line +=
        (boost::format("; %u elements may take some %.0f s") %
         scene.mesh.n_elements() % (iterations_of_next * larger * seconds))
          .str();
    context.log.write(line);
    if (!arrived)
      return {};
    const Refinement finer{2,
                           2,
                           parameters.contact.largest_penetration /
                             scene.parameters.contact.largest_penetration};
    return Transfer(coarse, state.matrix, scene.mesh, finer)(state);
  }
} // namespace fiberloom
