// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/scoped_timer.h>

#include <fiberloom/contact/contact_law.h>

#include <fiberloom/stages/cell.h>

#include <fiberloom/simulation/coarse_start.h>
#include <fiberloom/simulation/membrane_stiffness.h>
#include <fiberloom/simulation/stage_run.h>

#include <boost/format.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace fiberloom
{
  namespace
  {
    // Seconds without a line after which the next iteration has one: who waits
    // wants to see that something happens.
    constexpr double longest_silence = 10;

    // What an increment of a test takes, before there was one.
    constexpr double iterations_of_increment = 10;

    bool
    is_begun(const State &state)
    {
      return state.increment > 0 || state.step > 0;
    }

    /** Of the increment that ends at @p q [N mm]. */
    double
    dissipation(const std::vector<ContactElement> &contacts, const DofVector &q)
    {
      double dissipation = 0;
      for (const ContactElement &contact : contacts)
        if (contact.friction_limit > 0)
          dissipation += dissipated_energy(contact, section_pair(contact, q));
      return dissipation;
    }

    /** Of the bodies between two accepted states by the trapezoidal rule
     * [N mm]. */
    double
    work(const State &before, const State &after)
    {
      double work = 0;
      for (unsigned int b = 0; b < after.reactions.size(); ++b)
        {
          const Placement &from = before.placements[b],
                          &to   = after.placements[b];
          BodyVector motion;
          motion << to.position - from.position, to.turn - from.turn;
          work += .5 * (before.reactions[b] + after.reactions[b]).dot(motion);
        }
      return work;
    }

    std::vector<FrictionHistory>
    friction_history(const std::vector<ContactElement> &contacts,
                     const FiberMesh                   &mesh)
    {
      std::vector<FrictionHistory> history;
      for (const ContactElement &contact : contacts)
        if (contact.friction_limit > 0 && contact.normal_force > 0)
          history.push_back({contact.fibers,
                             {{mesh.parameter(contact.points[0]),
                               mesh.parameter(contact.points[1])}},
                             contact.slip});
      return history;
    }
  } // namespace



  StageRun::StageRun(const Scene      &scene,
                     const Stage      &stage,
                     const RunContext &context,
                     StageStatistics  &statistics,
                     const State      &state)
    : scene(scene)
    , stage(stage)
    , name(statistics.name)
    , context(context)
    , statistics(statistics)
    , breakage(stage.is_test() && can_break(scene.fibers) ?
                 std::make_unique<Breakage>(scene.fibers, scene.mesh) :
                 nullptr)
    , supports(stage.supports(is_begun(state) ? state.stage_start_q : state.q))
    , system(scene.mesh, supports, context.comm, scene.composite)
    , equilibrium(scene.parameters,
                  context.generator,
                  system,
                  statistics,
                  [this](const Equilibrium::Progress &progress) {
                    if (this->scene.parameters.output.iterations ||
                        this->context.log.silence() > longest_silence)
                      this->context.log.write(iteration_line(progress));
                    if (this->context.stop_requested())
                      throw StopRequested("");
                  })
    , shown(statistics)
    , counted_searches(context.generator.n_searches())
  {
    if (is_begun(state) && state.placements.size() != supports.bodies.size())
      throw InputError("stage " + name +
                       " was begun with other rigid bodies, "
                       "by another version: restart from a checkpoint before");
    if (state.coarse.q.size() > 0 &&
        state.coarse.placements.size() != supports.bodies.size())
      throw InputError("stage " + name +
                       " was begun on coarser meshes with other rigid bodies");
  }



  void
  StageRun::run(State                   &state,
                const IncrementObserver &observer,
                const Estimate          &estimate,
                const Keep              &keep,
                const Ahead             &ahead)
  {
    ScopedTimer timer(statistics.seconds.wall);
    this->ahead = ahead;
    if (!is_begun(state))
      {
        if (start_on_coarser_meshes(state) && keep)
          keep(state);
        const StageStatistics counted = statistics;
        // Interrupted here, the stage has to begin anew: keep the state apart.
        State      first   = begun(state);
        const bool arrived = take_fast_path(first);
        std::swap(state, first);
        if (arrived)
          end_increment(state, {first, counted}, estimate, observer);
        else if (stage.is_test())
          show_start(state, observer);
      }
    while (state.load < 1)
      {
        const Before before{state, statistics};
        take_increment(state);
        end_increment(state, before, estimate, observer);
      }
    statistics.converged = true;
  }



  bool
  StageRun::run_fast(State &state)
  {
    ScopedTimer timer(statistics.seconds.wall);
    start_on_coarser_meshes(state);
    State first = begun(state);
    if (!take_fast_path(first))
      return false;
    state = std::move(first);
    return true;
  }



  State
  StageRun::begun(const State &state) const
  {
    State first = state;
    stage.begin(first);
    first.stage_start_placements = first.placements;
    first.stage_start_q          = state.q;
    first.stage_start_zones      = state.contact.zones;
    first.step                   = stage.first_step(first);
    return first;
  }



  bool
  StageRun::start_on_coarser_meshes(State &state)
  {
    // The coarse fibers start where they are made, so these have to be there.
    if (!stage.starts_coarsely() || !state.stages_done.empty() ||
        state.coarse.q.size() > 0)
      return false;
    const auto coarse = start_coarsely(scene, context, statistics);
    if (coarse)
      state.coarse = {coarse->q, coarse->placements, coarse->contact};
    return coarse.has_value();
  }



  bool
  StageRun::take_fast_path(State &state)
  {
    const CoarseRest coarse = std::exchange(state.coarse, {});
    State            found  = state;
    bool             there  = false;
    if (stage.starts_coarsely() && coarse.q.size() > 0)
      {
        found.q          = coarse.q;
        found.placements = coarse.placements;
        found.contact    = coarse.contact;
        there            = stage.settle(found, state, equilibrium);
      }
    if (!there && !stage.take_fast_path(found, state, equilibrium))
      return false;
    accept(state, std::move(found), 1);
    return true;
  }



  void
  StageRun::end_increment(State                   &state,
                          const Before            &before,
                          const Estimate          &estimate,
                          const IncrementObserver &observer)
  {
    try
      {
        if (estimate && stage.way() && state.load < 1 &&
            state.load == stage.way()->farthest())
          estimate(before.state, state);
        show(state, observer);
      }
    catch (...)
      {
        // A run that goes on from there does it again, to show it.
        state      = before.state;
        statistics = before.statistics;
        throw;
      }
  }



  void
  StageRun::take_increment(State &state)
  {
    const SolverParameters &solver = scene.parameters.solver;
    bool                    passed = false; // in an attempt
    for (unsigned int cuts = 0;; ++cuts)
      {
        const double load = stage.end_of_increment(state.load, state.step);
        const unsigned int         newton_before = statistics.newton_iterations;
        State                      found         = state;
        const Equilibrium::Problem problem{
          state,
          {stage.targets(state.stage_start_placements, load),
           stage.node_forces(load)},
          stage.rule(load),
          stage.least_force_scale(load),
          load - state.load,
          stage.guess(state, load - state.load)};
        const bool solved = equilibrium.solve(found, problem) &&
                            break_fibers(found, problem, load);
        if (!system.has_potential(problem.targets))
          statistics.unsymmetric_systems +=
            statistics.newton_iterations - newton_before;
        if (solved)
          {
            found.step =
              std::min(solver.growth * found.step, stage.largest_step());
            if (load >= 1)
              last_start = state;
            accept(state, std::move(found), load);
            turn(state);
            return;
          }

        // An end that no increment reaches would be approached for ever.
        const bool tiny = std::ldexp(state.step, 2 * solver.largest_cuts) <
                          stage.largest_step();
        ++statistics.rejected_increments;
        passed = passed || equilibrium.ends_passed();
        if (cuts == solver.largest_cuts || tiny)
          throw StageFailure(
            "stage " + name + " stops at load " +
            (boost::format("%.4f") % state.load).str() +
            ": the increment failed after " + std::to_string(cuts) + " cuts" +
            (tiny ? ", tiny as it is" : "") + unbalanced(found) +
            (passed ? advice_on_passage() : advice()));
        state.step /= 2;
        context.log.write(
          (boost::format("  %-8s increment to load %.4f failed, cut "
                         "to %.2e") %
           name % load % state.step)
            .str());
      }
  }



  bool
  StageRun::break_fibers(State                      &found,
                         const Equilibrium::Problem &problem,
                         const double                load)
  {
    while (breakage)
      {
        const std::vector<unsigned int> broken =
          breakage->advance(found.q, found.fibers);
        if (broken.empty())
          break;
        for (const unsigned int element : broken)
          {
            Break &entry    = found.fibers.breaks[element];
            entry.stage     = name;
            entry.increment = found.increment + 1;
            entry.load      = load;
          }
        context.log.write(
          (boost::format("  %-6s breaks at load %.4f: %u, %u in all") % name %
           load % broken.size() % found.fibers.breaks.size())
            .str());
        if (!equilibrium.solve_again(found, problem))
          return false;
      }
    return true;
  }



  std::string
  StageRun::unbalanced(const State &state) const
  {
    const unsigned int block = system.most_unbalanced();
    const double       force = system.residual_norm();
    if (!(force > 0) || block >= system.layout().n_blocks())
      return "";
    const unsigned int n_fiber_nodes = scene.mesh.n_nodes();
    Vector3            place;
    std::string        what = "a node of the matrix";
    if (block < n_fiber_nodes)
      {
        unsigned int fiber = 0;
        while (block >= scene.mesh.lines()[fiber].first_node +
                          scene.mesh.lines()[fiber].n_nodes())
          ++fiber;
        const Tow &tow = scene.fibers.tows[scene.fibers.fibers[fiber].tow];
        place          = state.q.segment<3>(9 * block);
        what           = "fiber " + std::to_string(fiber);
        if (tow.family != Tow::Family::none)
          what += (tow.family == Tow::Family::warp ? " of warp tow " :
                                                     " of fill tow ") +
                  std::to_string(tow.number);
      }
    else if (block < system.layout().n_nodes())
      place =
        state.q.segment<3>(9 * n_fiber_nodes + 3 * (block - n_fiber_nodes));
    else
      {
        const unsigned int body = block - system.layout().n_nodes();
        place                   = state.placements[body].position;
        what                    = "body " + supports.bodies[body].name;
      }
    double largest = 0;
    for (const ContactElement &contact : equilibrium.contacts())
      largest = std::max(largest, contact.normal_force);
    return (boost::format(", %.1e N out of balance at %s (%.4g, %.4g, %.4g mm)"
                          ", the largest contact force being %.1e N") %
            force % what % place[0] % place[1] % place[2] % largest)
      .str();
  }



  std::string
  StageRun::advice_on_passage()
  {
    return ", on whose way fibers would pass through each other; what moves "
           "them has to lead around, or a smaller \"Largest penetration\" may "
           "hold them";
  }



  std::string
  StageRun::advice() const
  {
    if (equilibrium.ends_folded())
      return ", where elements of a fiber have folded or sections have given "
             "way; a smaller \"Largest move\" or longer elements may help";
    if (equilibrium.contacts().empty())
      return ", without contact; a larger \"Newton tolerance\" or a shorter "
             "\"Largest step\" may help";
    return "; a larger \"Largest penetration\" or \"Largest loop iterations\", or "
           "more elements per fiber may help";
  }



  void
  StageRun::accept(State &state, State &&found, const double load)
  {
    // However many iterations it took: one rotation for the increment.
    for (unsigned int b = 0; b < found.placements.size(); ++b)
      {
        const Placement &from = state.placements[b];
        Placement       &to   = found.placements[b];
        to.turn =
          from.turn +
          rotation_vector(from.rotation, to.rotation, to.turn - from.turn);
      }
    if (stage.way())
      {
        found.reactions = system.reactions();
        found.work += work(state, found);
      }
    // What jumps where fibers break does not tell how it goes on.
    if (found.fibers.breaks.size() > state.fibers.breaks.size())
      found.previous = {};
    else
      found.previous = {std::move(state.q),
                        std::move(state.placements),
                        state.load};
    state      = std::move(found);
    state.load = load;
    ++state.increment;
    state.contact.history =
      friction_history(equilibrium.contacts(), scene.mesh.with_images());
    state.contact.plates = system.plates().history(state);
    state.dissipation +=
      dissipation(equilibrium.contacts(), scene.mesh.with_images(state.q)) +
      system.dissipation(state);

    ++statistics.increments;
    statistics.searches += context.generator.n_searches() - counted_searches;
    counted_searches            = context.generator.n_searches();
    statistics.friction_history = state.contact.history.size();
    statistics.exchanged_values = system.matrix().n_exchanged();
    statistics.contact_elements = equilibrium.contacts().size();
    statistics.broken           = state.fibers.breaks.size();
    statistics.largest_penetration_over_radius =
      std::max(statistics.largest_penetration_over_radius,
               equilibrium.largest_penetration());
    statistics.largest_section_change =
      std::max(statistics.largest_section_change,
               scene.mesh.largest_section_change(state.q));
    statistics.elastic_energy =
      system.stored_energy(state, equilibrium.contacts());
    statistics.negative_pivots = equilibrium.negative_pivots();
    statistics.crossings_out_of_order =
      context.generator.crossings_out_of_order(state.q);
  }



  void
  StageRun::turn(State &state)
  {
    if (!stage.way() || !stage.way()->ends_leg(state.load))
      return;
    state.step     = stage.first_step(state);
    state.previous = {};
    statistics.turning_points.push_back({stage.way()->at(state.load),
                                         state.work,
                                         state.dissipation,
                                         statistics.elastic_energy});
  }



  void
  StageRun::show_start(State &state, const IncrementObserver &observer)
  {
    State seen = state;
    stage.unload(seen);
    const Equilibrium::Problem problem{
      state,
      {stage.targets(state.stage_start_placements, 0), stage.node_forces(0)},
      stage.rule(0)};
    equilibrium.evaluate(seen, problem);
    if (stage.way())
      {
        state.reactions           = system.reactions();
        statistics.turning_points = {
          {0,
           0,
           state.dissipation,
           system.stored_energy(seen, equilibrium.contacts())}};
      }
    report(seen, observer);
  }



  void
  StageRun::show(const State &state, const IncrementObserver &observer)
  {
    context.log.write(increment_line(state));
    shown = statistics;
    if (stage.finds_stiffness())
      {
        statistics.filled_thickness   = filled_thickness(scene, state);
        statistics.membrane_stiffness = membrane_stiffness(
          scene,
          {supports, state, equilibrium.contacts(), system.reactions()},
          context.comm,
          statistics);
      }
    report(state, observer);
  }



  void
  StageRun::report(const State &state, const IncrementObserver &observer) const
  {
    CurveRow curve = stage.curve(state, system.reactions());
    if (scene.fibers.cell)
      for (const auto &column : Cell::curve(scene, state, system.reactions()))
        curve.push_back(column);
    if (stage.shows_neighbors())
      curve.push_back({{"neighbor_force", Quantity::force, Role::response},
                       force_of_neighbors()});
    if (stage.shows_balance())
      for (const auto &column : contact_forces())
        curve.push_back(column);
    if (stage.way())
      curve.push_back({{"work", Quantity::energy}, state.work});
    if (stage.way() || stage.shows_balance())
      {
        curve.push_back({{"elastic_energy", Quantity::energy},
                         system.stored_energy(state, equilibrium.contacts())});
        curve.push_back({{"dissipation", Quantity::energy}, state.dissipation});
      }
    if (stage.shows_balance())
      curve.push_back({{"negative_pivots", Quantity::number},
                       state.increment > 0 ?
                         equilibrium.negative_pivots() :
                         std::numeric_limits<double>::quiet_NaN()});
    if (breakage)
      curve.push_back(
        {{"broken", Quantity::number}, double(state.fibers.breaks.size())});
    observer({name + (scene.parameters.is_preview() ? " (preview)" : ""),
              state,
              equilibrium.contacts(),
              supports,
              system.reactions(),
              curve,
              statistics,
              state.load >= 1,
              scene.composite});
  }



  double
  StageRun::seconds_of_stage() const
  {
    return statistics.seconds.detection + statistics.seconds.assembly +
           statistics.seconds.linear_solver + statistics.seconds.coarse;
  }



  double
  StageRun::seconds_of_increment() const
  {
    const double seconds = seconds_of_stage() - statistics.seconds.coarse;
    if (stage.is_test() && statistics.increments > 0)
      return seconds / statistics.increments;
    return std::max(ahead.seconds,
                    statistics.newton_iterations > 0 ?
                      iterations_of_increment * seconds /
                        statistics.newton_iterations :
                      0);
  }



  std::string
  StageRun::iteration_line(const Equilibrium::Progress &progress) const
  {
    return (boost::format("  %-6s iteration %3u  residual %.2e  last step "
                          "%.2e  damping %.1e  contacts %6u  penetration "
                          "%.4f r  %7.1f s") %
            name %
            (statistics.newton_iterations - shown.newton_iterations + 1) %
            progress.residual % progress.factor % progress.damping %
            equilibrium.contacts().size() % equilibrium.largest_penetration() %
            seconds_of_stage())
      .str();
  }



  double
  StageRun::force_of_neighbors() const
  {
    const auto &tows = scene.fibers.tows;
    double      sum  = 0;
    const auto  tow  = [&](const ContactElement &contact,
                         const unsigned int    side) {
      return scene.mesh.with_images().lines()[contact.fibers[side]].tow;
    };
    for (const ContactElement &contact : equilibrium.contacts())
      if (tow(contact, 0) != tow(contact, 1) &&
          tows[tow(contact, 0)].family == tows[tow(contact, 1)].family)
        sum += contact.normal_force;
    return sum;
  }



  CurveRow
  StageRun::contact_forces() const
  {
    double sum = 0, largest = 0;
    for (const ContactElement &contact : equilibrium.contacts())
      {
        sum += contact.normal_force;
        largest = std::max(largest, contact.normal_force);
      }
    return {{{"contact_force_sum", Quantity::force}, sum},
            {{"largest_contact_force", Quantity::force}, largest}};
  }



  std::string
  StageRun::increment_line(const State &state) const
  {
    unsigned int to_come = ahead.increments;
    if (state.load < 1)
      to_come += stage.n_increments(state, state.load, state.step);
    return (boost::format("%-8s %3u  load %.4f  contact/normal/newton "
                          "%2u/%2u/%3u  contacts %6u  penetration %.4f r  "
                          "%7.1f s  remaining %7.1f s") %
            name % state.increment % state.load %
            (statistics.contact_updates - shown.contact_updates) %
            (statistics.normal_updates - shown.normal_updates) %
            (statistics.newton_iterations - shown.newton_iterations) %
            equilibrium.contacts().size() % equilibrium.largest_penetration() %
            seconds_of_stage() % (to_come * seconds_of_increment()))
      .str();
  }
} // namespace fiberloom
