// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>

#include <fiberloom/stages/relax.h>

#include <fiberloom/simulation/error_estimate.h>
#include <fiberloom/simulation/refinement.h>

#include <boost/format.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace fiberloom
{
  namespace
  {
    // Balance is not waited for where fibers touch: the first iterations
    // already give a stiff response, and soft fibers take many. As many again
    // are made until they change the curve by no more than this part of what
    // all have changed, or by what no accuracy asks for; not in so many, and
    // nothing is known of the error.
    constexpr unsigned int first_iterations = 2, most_iterations = 64;
    constexpr double       settled_part = .05, negligible = 2e-4;

    // Columns that are smaller than this part of what is usual have no scale.
    constexpr double least_scale = 1e-3;

    // With so much stiffer contact the penetration nearly goes.
    constexpr double stiffening = 4;

    // A larger estimate is checked by half the way to that stiffness. Where
    // both differ by more than this part of it, fibers jump from one
    // equilibrium to another, and nothing is known of the error.
    constexpr double checked_from = .05, largest_disagreement = .5;

    // What parts of different signs leave of the largest of them counts for no
    // less: none is known better.
    constexpr double least_part = .5;

    // Of second order: halved, a length leaves a quarter of its error.
    constexpr double of_second_order = 4. / 3;

    // An estimated error of a loading curve, the one that "draft" may have.
    constexpr double too_much = .1;

    /** The setting that makes the largest part of @p error smaller. */
    std::string
    finer_setting(const ErrorEstimate &error)
    {
      const std::pair<double, const char *> parts[] = {
        {error.mesh, "a larger \"Elements per fiber\""},
        {error.stations, "a larger \"Stations per element\""},
        {error.penetration, "a smaller \"Largest penetration\""},
        {error.matrix, "larger \"Cells along x\" and \"Cells along y\""},
        {error.tolerance,
         "a smaller \"Contact tolerance\" or \"Newton tolerance\""}};
      double      largest = 0;
      std::string setting;
      for (const auto &[part, finer] : parts)
        if (part > largest) // false for NaN
          {
            largest = part;
            setting = finer;
          }
      return setting;
    }

    /** Of contacts [mm], each as much as its force. */
    double
    mean_penetration(const std::vector<ContactElement> &contacts)
    {
      double sum = 0, force = 0;
      for (const ContactElement &contact : contacts)
        {
          sum -= contact.normal_force * contact.gap;
          force += contact.normal_force;
        }
      return force > 0 ? sum / force : 0;
    }

    // What a tolerance leaves is in proportion to it.
    constexpr double of_tolerance = 1 / (1 - tighter);

    struct Outcome
    {
      CurveRow begun; // the curve's row where the stage began, without forces
      CurveRow curve;
      double   penetration = 0; // [mm]
      double   unresolved  = 0; // force that the solver leaves [N]
      double   lever       = 0; // as long as the largest body [mm]
    };



    /** Of the nodes that a body holds, the largest distance along an axis. */
    double
    largest_extent(const Supports &supports, const DofVector &q)
    {
      std::vector<Eigen::AlignedBox3d> boxes(supports.bodies.size());
      for (const Attachment &attachment : supports.attachments)
        boxes[attachment.body].extend(q.segment<3>(9 * attachment.node));
      double largest = 0;
      for (const Eigen::AlignedBox3d &box : boxes)
        if (!box.isEmpty())
          largest = std::max(largest, box.sizes().maxCoeff());
      return largest;
    }



    /**
     * Largest change of the columns of a quantity since the stage began, forces
     * counted from zero. Moments are about a center that might as well be
     * elsewhere in its body: none counts for less than a force times the
     * largest body. Quantities of which nothing to speak of happens are left
     * out, @p radius being that of a fiber, and forces that the
     * solver does not resolve to a thousandth.
     */
    std::map<Quantity, double>
    scales(const Outcome &outcome, const double radius)
    {
      std::map<Quantity, double> largest;
      for (unsigned int c = 0; c < outcome.curve.size(); ++c)
        {
          const auto &[column, value] = outcome.curve[c];
          double &scale               = largest[column.quantity];
          scale = std::max(scale, std::abs(value - outcome.begun[c].second));
        }
      const double force = largest[Quantity::force];
      const std::vector<std::pair<Quantity, double>> usual{
        {Quantity::force, outcome.unresolved / (least_scale * least_scale)},
        {Quantity::moment, force * radius},
        {Quantity::pressure, 0},
        {Quantity::force_per_width, 0},
        {Quantity::length, radius},
        {Quantity::angle, 1}};
      double &moment = largest[Quantity::moment];
      moment         = std::max(moment, force * outcome.lever);
      std::map<Quantity, double> scales;
      for (const auto &[quantity, value] : usual)
        if (largest[quantity] > least_scale * value)
          scales[quantity] = largest[quantity];
      return scales;
    }



    /** Of each column whose quantity has a scale, over that. */
    Eigen::ArrayXd
    change(const Outcome                    &from,
           const Outcome                    &to,
           const std::map<Quantity, double> &scale)
    {
      Eigen::ArrayXd change(from.curve.size());
      for (unsigned int c = 0; c < change.size(); ++c)
        {
          const auto found = scale.find(from.curve[c].first.quantity);
          change[c] =
            found == scale.end() ?
              0 :
              (to.curve[c].second - from.curve[c].second) / found->second;
        }
      return change;
    }



    double
    largest(const Eigen::ArrayXd &change)
    {
      return change.abs().maxCoeff<Eigen::PropagateNaN>();
    }



    bool
    follows_relax(const State &state)
    {
      return !state.stages_done.empty() &&
             is_stage(state.stages_done.back(), &StageType::only_relaxes);
    }



    State
    at_start_of_stage(State state)
    {
      state.q             = state.stage_start_q;
      state.placements    = state.stage_start_placements;
      state.contact.zones = state.stage_start_zones;
      state.contact.history.clear();
      state.contact.plates.clear();
      state.load = 0;
      return state;
    }



    /** A state, and what iterations make of it. */
    struct Response
    {
      Outcome before, after;
    };

    /** A stage, and what iterations of it need. */
    class Trial
    {
    public:
      /** Of a stage that began at @p begun . */
      Trial(const Scene                 &scene,
            std::unique_ptr<Stage>       stage_of_scene,
            const DofVector             &begun,
            const MPI_Comm               comm,
            const std::function<void()> &ask)
        : scene(scene)
        , stage(std::move(stage_of_scene))
        , supports(stage->supports(begun))
        , system(scene.mesh, supports, comm, scene.composite)
        , generator(scene.fibers, scene.mesh, scene.parameters.contact, comm)
        , equilibrium(scene.parameters,
                      generator,
                      system,
                      statistics,
                      [&ask](const Equilibrium::Progress &) { ask(); })
      {}

      /** From @p before to @p load , with placements as at the @p start . */
      Problem
      problem(const State                  &before,
              const std::vector<Placement> &start,
              const double                  load) const
      {
        Problem problem{before,
                        {stage->targets(start, load), stage->node_forces(load)},
                        stage->rule(load)};
        problem.rule.points_follow = true;
        problem.is_near            = true;
        return problem;
      }

      /** What the curve shows at @p state . */
      Outcome
      outcome(const Problem &problem, State &state);

      /** Balance, or StageFailure where that takes too long. */
      void
      balance(const Problem &problem, State &state);

      /**
       * Iterates until what that changes of the curve has settled; @p from :
       * what changes are counted from, or null: from @p state . Its contact is
       * @p stiffer than where it was found. Throws StageFailure where
       * iterations go on changing it.
       */
      Response
      settle(const Problem &problem,
             State         &state,
             const double   stiffer,
             const Outcome *from);

    private:
      const Scene            scene;
      std::unique_ptr<Stage> stage;
      Supports               supports;
      System                 system;
      StageStatistics        statistics;
      ContactGenerator       generator;
      Equilibrium            equilibrium;
    };



    Outcome
    Trial::outcome(const Problem &problem, State &state)
    {
      std::vector<ContactElement> contacts = generator.generate(
        state.q, problem.before.q, problem.rule, state.contact);
      system.reinit(contacts);
      system.assemble_residual(state, problem.targets, contacts);
      return {stage->curve(at_start_of_stage(state),
                           std::vector<BodyVector>(supports.bodies.size(),
                                                   BodyVector::Zero())),
              stage->curve(state, system.reactions()),
              mean_penetration(contacts),
              contacts.empty() ? scene.parameters.solver.newton_tolerance *
                                   system.force_scale() :
                                 0,
              largest_extent(supports, state.q)};
    }



    void
    Trial::balance(const Problem &problem, State &state)
    {
      if (!equilibrium.approach(state, problem, most_iterations))
        throw StageFailure("the iterations of an estimate do not settle");
    }



    Response
    Trial::settle(const Problem &problem,
                  State         &state,
                  const double   stiffer,
                  const Outcome *from)
    {
      Response     response{outcome(problem, state), {}};
      unsigned int done = 0;
      for (unsigned int n = first_iterations; done < most_iterations; n = done)
        {
          const Outcome last = response.after;
          const bool    at_rest =
            equilibrium.approach(state, problem, n, done == 0 ? stiffer : 1);
          response.after = outcome(problem, state);
          if (at_rest)
            return response;
          if (done > 0)
            {
              const auto scale =
                scales(response.after, scene.mesh.smallest_radius());
              const double moved = largest(
                change(from ? *from : response.before, response.after, scale));
              if (largest(change(last, response.after, scale)) <=
                  std::max(settled_part * moved, negligible))
                return response;
            }
          done += n;
        }
      throw StageFailure("the iterations of an estimate do not settle");
    }



    /**
     * With stiffer contact the sample would have been relaxed elsewhere: moves
     * @p start and @p state , of the finer @p scene , by as much as where their
     * stage begins moves. Throws StageFailure where that takes too long.
     */
    void
    begin_where_relaxed(const Scene                 &scene,
                        const MPI_Comm               comm,
                        const std::function<void()> &ask,
                        State                       &start,
                        State                       &state)
    {
      State relaxed = at_start_of_stage(state);
      auto  relax   = std::make_unique<Relax>(scene);
      relax->begin(relaxed);
      Trial       trial(scene, std::move(relax), relaxed.q, comm, ask);
      const State before    = relaxed;
      Problem     problem   = trial.problem(before, before.placements, 1);
      problem.rule.friction = false;
      trial.balance(problem, relaxed);

      for (State *moved : {&start, &state})
        {
          moved->q += relaxed.q - before.q;
          moved->stage_start_q = relaxed.q;
          // The test may have more bodies: its plates stay where they are.
          for (unsigned int b = 0; b < relaxed.placements.size(); ++b)
            {
              moved->placements[b].position +=
                relaxed.placements[b].position - before.placements[b].position;
              moved->stage_start_placements[b] = relaxed.placements[b];
            }
        }
    }



    /** Of the last increment of a stage, by refining its scene. */
    struct Estimate
    {
      ErrorEstimate
      error();

      /** What iterations make of @p end with other parameters, where an
       * increment led to from @p beginning ; as Trial::settle(). */
      Response
      respond(const State      &beginning,
              const State      &end,
              const Refinement &refinement,
              const Outcome    *from = nullptr) const;

      /** By how much the curve changes. */
      Eigen::ArrayXd
      change_by(const Refinement &refinement) const
      {
        return change(now,
                      respond(before, found, refinement, &now).after,
                      scale);
      }

      /** What stiffer contact changes where the stage begins: it would not be
       * there if all had been done with it. */
      Eigen::ArrayXd
      change_of_start(const double factor) const;

      /** Of the penetration, if contact that is so much stiffer tells. */
      Eigen::ArrayXd
      penetration_by(const double factor) const;

      const Scene                 &scene;
      const std::string           &name;
      const State                 &before, &found;
      const MPI_Comm               comm;
      const std::function<void()> &ask;
      Outcome                      now   = {}; // without refinement
      std::map<Quantity, double>   scale = {};
    };



    Response
    Estimate::respond(const State      &beginning,
                      const State      &end,
                      const Refinement &refinement,
                      const Outcome    *from) const
    {
      ask();
      const Parameters parameters = refine(scene.parameters, refinement);
      const FiberSet   fibers     = build_fiber_set(parameters);
      const FiberMesh  mesh(fibers);
      const Transfer   transfer(scene, end.matrix, mesh, refinement);
      const Scene      refined{parameters, fibers, mesh, transfer.finer()};
      State            start = transfer(beginning);
      State            state = transfer(end);
      if (refinement.stiffness != 1 && follows_relax(beginning))
        begin_where_relaxed(refined, comm, ask, start, state);
      state.contact.history = start.contact.history;
      state.contact.plates  = start.contact.plates;
      Trial trial(
        refined, create_stage(name, refined), state.stage_start_q, comm, ask);
      return trial.settle(trial.problem(start,
                                        state.stage_start_placements,
                                        end.load),
                          state,
                          refinement.stiffness,
                          from);
    }



    Eigen::ArrayXd
    Estimate::change_of_start(const double factor) const
    {
      if (found.stages_done.empty() || follows_relax(found))
        return Eigen::ArrayXd::Zero(now.curve.size());
      const State begun = at_start_of_stage(found);
      return change(respond(begun, begun, {1, 1, 1}).after,
                    respond(begun, begun, {1, 1, factor}).after,
                    scale);
    }



    Eigen::ArrayXd
    Estimate::penetration_by(const double factor) const
    {
      // The penetration goes with the error, and both are to vanish.
      const Outcome stiffer =
        respond(before, found, {1, 1, factor}, &now).after;
      return now.penetration / (now.penetration - stiffer.penetration) *
             (change(now, stiffer, scale) - change_of_start(factor));
    }



    ErrorEstimate
    Estimate::error()
    {
      const Response unrefined = respond(before, found, {});
      now                      = unrefined.after;
      scale                    = scales(now, scene.mesh.smallest_radius());
      if (scale.count(Quantity::force) + scale.count(Quantity::moment) +
            scale.count(Quantity::pressure) ==
          0)
        return {};
      const Eigen::ArrayXd mesh = of_second_order * change_by({2, 1, 1});
      // Of a stiffness that the scene gives, penetration is the model's.
      const bool     of_model = scene.parameters.contact.line_stiffness > 0;
      Eigen::ArrayXd matrix   = Eigen::ArrayXd::Zero(mesh.size()),
                     stations = matrix, penetration = matrix;
      if (scene.composite)
        matrix = of_second_order * change_by({1, 1, 1, 2});
      if (now.penetration > 0)
        stations = of_second_order * change_by({1, 2, 1});
      if (now.penetration > 0 && !of_model)
        {
          penetration = penetration_by(stiffening);
          if (largest(penetration) > checked_from &&
              largest(penetration_by(std::sqrt(stiffening)) - penetration) >
                largest_disagreement * largest(penetration))
            return {};
        }
      const Eigen::ArrayXd tolerance =
        of_tolerance * change(unrefined.before, now, scale);
      const Eigen::ArrayXd together =
        (mesh + stations + penetration + matrix + tolerance).abs();
      if (!together.allFinite())
        return {};
      const Eigen::ArrayXd alone =
        mesh.abs().max(stations.abs()).max(penetration.abs()).max(matrix.abs());
      const Eigen::ArrayXd total = together.max(least_part * alone);
      Eigen::Index         worst;
      total.maxCoeff(&worst);
      const Column    &column    = now.curve[worst].first;
      const auto       its_scale = scale.find(column.quantity);
      constexpr double none      = std::numeric_limits<double>::quiet_NaN();
      return {largest(mesh),
              largest(stations),
              of_model ? none : largest(penetration),
              scene.composite ? largest(matrix) : none,
              largest(total),
              largest(tolerance),
              column.heading(),
              its_scale == scale.end() ? 0 : total[worst] * its_scale->second};
    }
  } // namespace



  ErrorEstimate
  estimate_error(const Scene                 &scene,
                 const LastIncrement         &last,
                 const MPI_Comm               comm,
                 const std::function<void()> &ask)
  {
    if (!create_stage(last.stage, scene)->is_test())
      return {};
    try
      {
        return Estimate{scene, last.stage, last.before, last.found, comm, ask}
          .error();
      }
    catch (const StageFailure &)
      {
        return {};
      }
  }



  std::vector<std::string>
  described(const ErrorEstimate &error)
  {
    if (!std::isfinite(error.total))
      return {"no estimate of the curve's error: with finer settings nothing "
              "settles, fibers jump to another equilibrium, or there is no "
              "force"};
    const auto part = [](const std::string &name, const double of) {
      return std::isfinite(of) ?
               str(boost::format(", %s %.2g %%") % name % (100 * of)) :
               "";
    };
    std::vector<std::string> lines = {
      (boost::format("estimated error of the loading curve %.2g %%, %.2g in "
                     "%s: mesh %.2g %%") %
       (100 * error.total) % std::abs(error.change) % error.column %
       (100 * error.mesh))
        .str() +
      part("stations", error.stations) +
      part("penetration", error.penetration) + part("matrix", error.matrix) +
      part("tolerance", error.tolerance)};
    if (error.total > too_much)
      lines.push_back("that is too much to be relied on; " +
                      finer_setting(error) + " may help");
    return lines;
  }
} // namespace fiberloom
