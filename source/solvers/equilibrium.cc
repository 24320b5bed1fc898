// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/parameters.h>
#include <fiberloom/base/scoped_timer.h>

#include <fiberloom/contact/contact_law.h>

#include <fiberloom/solvers/equilibrium.h>

#include <algorithm>
#include <cmath>

namespace fiberloom
{
  namespace
  {
    // The damped loop stiffens as soon as the residual is below this multiple
    // of the tolerance, not in every iteration, and at most so many times.
    constexpr double       stiffening_from = 10, loosest_stiffening = .1;
    constexpr unsigned int least_between       = 2;
    constexpr unsigned int largest_stiffenings = 20;

    // Inner tolerance: a tenth of what the outer loop still has to remove.
    constexpr double inner_reduction = .1, loosest_inner = .02,
                     tightest_inner = 1e-5;

    // Of the linear systems: what they leave is well below what is allowed.
    constexpr double linear_reduction = .01, loosest_linear = 1e-4,
                     tightest_linear = 1e-9;

    // A tight fabric, whose contact forces are large, needs more.
    constexpr double stronger_damping = 8;

    // A loop on normals that does not even contract by this in so many passes.
    constexpr double       slow_ratio  = .5;
    constexpr unsigned int slow_passes = 4;

    // As the allowed overlap shrinks, the energy has to rise at first.
    constexpr unsigned int shrinking_search_from = 2;

    // The ends of a fabric are moved by no more than this part of their way in
    // the increment, or of the radius, in one step.
    constexpr double part_of_ends = .15, least_limit = .1;

    // Of contacts that are about to close, over the largest contact force.
    constexpr double approach_force = .01, approach_over_tolerance = .3;

    // Times the iterations that a loop may take far from balance.
    constexpr unsigned int patience_near_end = 4;

    // A machine with other work on it is not always as fast.
    constexpr unsigned int yardstick_every = 10;

    constexpr double       diverged      = 1e8;
    constexpr double       shift_over_Er = 1e-4, shift_over_damping = 8;
    constexpr unsigned int largest_halvings = 8;

    // Contacts that open and close by turns bring the same residuals back, or
    // throw them up again and again.
    bool
    goes_round(const std::vector<double> &residuals)
    {
      constexpr unsigned int longest_period = 8, window = 12, most_rises = 2;
      constexpr double       rise = 1.5;
      const unsigned int     n    = residuals.size();
      const auto same = [&](const unsigned int i, const unsigned int j) {
        return std::abs(residuals[n - i] / residuals[n - j] - 1) < .005;
      };
      for (unsigned int period = 2; period <= longest_period; ++period)
        if (n >= period + 2 && same(1, 1 + period) && same(2, 2 + period) &&
            !same(1, 2))
          return true;
      unsigned int rises = 0;
      for (unsigned int i = n > window ? n - window : 1; i < n; ++i)
        rises += residuals[i] > rise * residuals[i - 1];
      return rises > most_rises;
    }

    // Soft fibers creep into place; on the way some are thrown now and then.
    bool
    is_near(const std::vector<double> &residuals)
    {
      constexpr int    window = 12;
      constexpr double near   = .1;
      return int(residuals.size()) > window &&
             *std::min_element(residuals.end() - window, residuals.end()) <
               near;
    }
  } // namespace



  Equilibrium::Equilibrium(const FiberMesh  &mesh,
                           const Parameters &parameters,
                           ContactGenerator &generator,
                           System           &system,
                           StageStatistics  &statistics,
                           Watch             watch)
    : mesh(mesh)
    , parameters(parameters)
    , generator(generator)
    , system(system)
    , linear_solver(system, parameters.solver.linear_solver)
    , statistics(statistics)
    , watch(std::move(watch))
    , increment(mesh, parameters.solver, generator, system, statistics)
    , damping(mesh)
    , by_newton(mesh,
                system,
                linear_solver,
                statistics,
                increment,
                parameters.solver.largest_move,
                this->watch)
    , penetration(mesh, parameters.contact, system.motion())
    , prescribed_limit(parameters.solver.largest_move)
  {}



  double
  Equilibrium::tightest() const
  {
    return std::min(tightest_inner, increment.tolerance());
  }



  double
  Equilibrium::search_along(const State           &state,
                            const Problem         &problem,
                            const Eigen::VectorXd &step,
                            const double           factor) const
  {
    const double before = system.energy(state, increment.contacts);
    double       tried  = factor;
    for (unsigned int i = 0; i < largest_halvings; ++i, tried /= 2)
      {
        State moved;
        moved.q          = state.q;
        moved.placements = state.placements;
        system.motion().advance(moved, step, tried);
        const double work = system.load_work(problem.targets, state, moved);
        if (system.energy(moved, increment.contacts) - work <=
            before + 1e-12 * std::abs(before))
          return tried;
      }
    return tried;
  }



  Equilibrium::Step
  Equilibrium::newton_step(State         &state,
                           const Problem &problem,
                           const double   tolerance,
                           const bool     search_line)
  {
    const double approach =
      in_one_loop ? std::min(approach_force,
                             approach_over_tolerance * increment.tolerance()) *
                      increment.scale(problem) :
                    0;
    for (ContactElement &contact : increment.contacts)
      contact.approach_force = approach;
    increment.assemble(state, problem);
    const double scale    = increment.scale(problem);
    const double residual = system.residual_norm() / scale;
    const bool   moves    = system.motion().moves(state, problem.targets);
    last_residual         = residual;
    watch({residual, damping.over_Er(), last_factor});
    const double allowed = std::max(tolerance, system.rounding_force() / scale);
    const bool   balanced = !moves && residual < allowed;
    const bool   at_rest =
      !pulls ||
      damping.follow_reactions(system.reactions(), balanced, tolerance);
    if (balanced && at_rest)
      {
        folded = mesh.is_folded(state.q);
        return folded ? Step::failed : Step::converged;
      }
    if (!(residual < diverged))
      return Step::failed;
    // Newton's method converges by exact steps, the damped loop does not; and
    // prescribed increments stand beside forces on the right hand side.
    const double linear_tolerance =
      moves || damping.over_Er() == 0 ?
        tightest_linear :
        std::clamp(linear_reduction * allowed / residual,
                   tightest_linear,
                   loosest_linear);

    // Without one, neither its curvature nor its decrease says anything.
    const bool            has_potential = system.has_potential(problem.targets);
    std::vector<double>   solution;
    LinearSolver::Outcome outcome;
    {
      ScopedTimer timer(statistics.seconds.linear_solver);
      outcome = linear_solver.solve(
        system.matrix(),
        state.q,
        system.right_hand_side(),
        damping.of_blocks(system.layout().n_blocks(), system.stiffness_scale()),
        std::max(shift_over_Er, shift_over_damping * damping.usual_over_Er()) *
          system.stiffness_scale(),
        solution,
        has_potential ? LinearSolver::Indefinite::shifted :
                        LinearSolver::Indefinite::accepted,
        linear_tolerance);
    }
    if (parameters.solver.benchmark &&
        statistics.newton_iterations % yardstick_every == 0)
      {
        const double seconds =
          LinearSolver::time_double_factorization(system.matrix());
        ++n_yardsticks;
        statistics.seconds.yardstick +=
          (seconds - statistics.seconds.yardstick) / n_yardsticks;
      }
    ++statistics.newton_iterations;
    add(statistics, outcome);
    last_negative_pivots = outcome.negative_pivots;

    const Eigen::VectorXd step = system.gather(solution);
    const double          move = system.motion().largest_move(step);
    if (!std::isfinite(move))
      return Step::failed;
    double factor = longest_step * damping.relaxation(step);
    if (const double limit = parameters.solver.largest_move;
        limit > 0 && !increment.contacts.empty())
      {
        factor = std::min(factor, limit / std::max(move, limit));
        if (moves)
          factor = std::min(factor,
                            prescribed_limit /
                              std::max(prescribed_limit,
                                       system.motion().largest_prescribed_move(
                                         state, problem.targets)));
      }
    last_cut = 1;
    if (search_line && !moves && has_potential)
      {
        ScopedTimer  timer(statistics.seconds.assembly);
        const double found = search_along(state, problem, step, factor);
        last_cut           = found / factor;
        factor             = found;
      }
    last_factor = factor;
    damping.remember(factor * step);
    if (in_one_loop)
      damping.follow_fibers(moves ? prescribed_limit : 0);
    system.motion().advance(state, step, factor);
    return Step::moved;
  }



  bool
  Equilibrium::newton(State         &state,
                      const Problem &problem,
                      const double   tolerance)
  {
    for (unsigned int i = 0; i < parameters.solver.largest_newton_iterations;
         ++i)
      // Contacts that close on the way are the scale from then on: what was
      // asked for without them would be beyond rounding.
      switch (newton_step(state,
                          problem,
                          std::max(tolerance, tightest()),
                          i >= parameters.solver.line_search_from))
        {
          case Step::converged:
            return true;
          case Step::failed:
            return false;
          case Step::moved:
            // Slender fibers that are few come back by themselves.
            if (generator.weaves() && penetration.is_thrown(increment.contacts))
              return false;
            break;
        }
    return false;
  }



  bool
  Equilibrium::follows(const Problem &problem) const
  {
    return generator.weaves() && !problem.rule.from_above &&
           !increment.contacts.empty();
  }



  void
  Equilibrium::begin(State &state, const Problem &problem)
  {
    linear_solver.forget();
    state = problem.before;
    increment.generate(state, problem);
    if (follows(problem) && system.motion().moves(state, problem.targets) &&
        penetration.stiffen(increment.contacts, state.contact.zones))
      increment.generate(state, problem);
  }



  bool
  Equilibrium::extrapolate(State &state, const Problem &problem)
  {
    begin(state, problem);
    penetration.remember(increment.contacts);
    // What does not touch bends freely: turns are too large to go on straight.
    if (increment.contacts.empty())
      return true;
    bool too_far = false; // the last guess there is
    for (const Past *past : {&problem.before.previous, &problem.even})
      if (past->q.size() > 0)
        {
          system.motion().extrapolate(state,
                                      *past,
                                      problem.targets,
                                      problem.load_step);
          // An end that turns back folds the elements next to it. And thrown
          // apart, fibers that are held in each other would come back unseen,
          // on any side.
          too_far = mesh.is_folded(state.q);
          if (!too_far)
            {
              increment.generate(state, problem);
              too_far = penetration.is_thrown(increment.contacts);
              if (!too_far && !increment.contacts.empty())
                return true;
            }
          begin(state, problem);
        }
    return !too_far || problem.even.q.size() == 0;
  }



  bool
  Equilibrium::solve(State &state, const Problem &problem)
  {
    passed = false;
    if (!find(state, problem))
      return false;
    // Only a weave turns sides, as its pattern says.
    passed =
      !problem.rule.from_above && generator.may_pass(problem.before.q, state.q);
    return !passed;
  }



  bool
  Equilibrium::find(State &state, const Problem &problem)
  {
    folded = false;
    if (!extrapolate(state, problem))
      return false;
    if (parameters.solver.loops == "newton" && uses_newton(state, problem))
      return solve_by_newton(state, problem);

    const auto one_loop = [&](const double damping) {
      return solve_in_one_loop(state,
                               problem,
                               parameters.solver.largest_loop_iterations,
                               damping);
    };
    const auto [usual_damping, strong_damping] = dampings();

    // Of the many parallel fibers of a fabric some always need normals that
    // follow every iteration: the nested loops are for when that fails.
    const bool loop_first = follows(problem);
    if (loop_first)
      {
        const double ends =
          system.motion().largest_prescribed_move(problem.before,
                                                  problem.targets);
        if (parameters.solver.largest_move > 0)
          prescribed_limit =
            std::min(parameters.solver.largest_move,
                     std::max(least_limit, part_of_ends * ends));
        const bool found = one_loop(usual_damping);
        prescribed_limit = parameters.solver.largest_move;
        if (found)
          return true;
        begin(state, problem);
      }

    const Outcome nested = solve_nested(state, problem);
    if (nested == Outcome::converged)
      return true;
    if (increment.contacts.empty())
      return false;

    // Frozen normals let soft modes of a tow run away, or never settle. In the
    // damped loop normals follow every iteration: from where slow loops got,
    // else from the last good state, unless it has failed from there.
    const bool goes_on =
      nested == Outcome::slow && !penetration.is_thrown(increment.contacts);
    if (goes_on || !loop_first)
      {
        if (!goes_on)
          state = problem.before;
        if (one_loop(usual_damping))
          return true;
      }
    // Strong damping stops on the way, with forces that soft fibers have not
    // yet given up: it only leads to where the usual one can begin.
    state = problem.before;
    return one_loop(strong_damping) && one_loop(usual_damping);
  }



  bool
  Equilibrium::uses_newton(const State &state, const Problem &problem) const
  {
    return !increment.contacts.empty() && !problem.rule.from_above &&
           !system.motion().moves(state, problem.targets) &&
           system.has_potential(problem.targets);
  }



  bool
  Equilibrium::solve_by_newton(State &state, const Problem &problem)
  {
    Problem following            = problem;
    following.rule.points_follow = true;
    for (unsigned int k = 0; k < largest_stiffenings; ++k)
      {
        if (!by_newton.solve(state,
                             following,
                             parameters.solver.contact_tolerance,
                             parameters.solver.largest_loop_iterations))
          return false;
        last_negative_pivots = by_newton.negative_pivots();
        folded               = mesh.is_folded(state.q);
        if (folded)
          return false;
        if (!penetration.needs_stiffening(increment.contacts))
          return true;
        penetration.stiffen(increment.contacts, state.contact.zones);
      }
    return false;
  }



  std::array<double, 2>
  Equilibrium::dampings() const
  {
    return {{parameters.solver.damping,
             stronger_damping * parameters.solver.damping}};
  }



  Equilibrium::Outcome
  Equilibrium::solve_nested(State &state, const Problem &problem)
  {
    damping.reset(0);
    pulls = in_one_loop = false;
    for (unsigned int pass = 0; pass < parameters.solver.largest_contact_passes;
         ++pass)
      {
        if (pass > 0)
          increment.generate(state, problem);
        bool                settled = false;
        std::vector<double> residuals; // of the passes on normals
        for (unsigned int normals = 0;
             normals < parameters.solver.largest_normal_passes && !settled;
             ++normals)
          {
            if (normals > 0)
              increment.update_normals(state, problem);
            const double residual = increment.measure(state, problem);
            settled               = residual < increment.tolerance() &&
                      !system.motion().moves(state, problem.targets);
            if (settled)
              {
                if (normals == 0 &&
                    !penetration.needs_stiffening(increment.contacts))
                  return Outcome::converged;
                break;
              }
            residuals.push_back(residual);
            if (normals > slow_passes &&
                residual > slow_ratio * residuals[normals - slow_passes])
              return Outcome::slow;

            double inner = increment.tolerance();
            if (!increment.contacts.empty() &&
                !system.motion().moves(state, problem.targets))
              inner = std::clamp(inner_reduction * residual,
                                 tightest(),
                                 loosest_inner);
            if (!newton(state, problem, inner))
              return Outcome::failed;
          }
        if (!settled)
          return Outcome::slow;
        if (increment.contacts.empty())
          {
            // What moved without contact may have come to touch.
            increment.generate(state, problem);
            if (increment.contacts.empty())
              return Outcome::converged;
          }
        if (penetration.needs_stiffening(increment.contacts))
          penetration.stiffen(increment.contacts, state.contact.zones);
      }
    return Outcome::slow;
  }



  void
  Equilibrium::iterate(State             &state,
                       const Problem     &problem,
                       const unsigned int n,
                       const double       damping_over_Er)
  {
    damping.reset(damping_over_Er);
    pulls = in_one_loop = false;
    for (unsigned int i = 0; i < n; ++i)
      {
        increment.generate(state, problem);
        if (newton_step(state,
                        problem,
                        increment.tolerance(),
                        i >= shrinking_search_from) != Step::moved)
          return;
      }
  }



  bool
  Equilibrium::solve_in_one_loop(State             &state,
                                 const Problem     &problem,
                                 const unsigned int largest_iterations,
                                 const double       least_damping)
  {
    pulls = follows(problem) &&
            system.motion().moves(problem.before, problem.targets);
    damping.reset(least_damping);
    in_one_loop = true;
    std::vector<double> residuals;
    unsigned int        stiffenings = 0, since_stiffening = 0;
    const auto          stiffen = [&]() {
      penetration.stiffen(increment.contacts, state.contact.zones);
      ++stiffenings;
      since_stiffening = 0;
    };
    // Each stiffening is progress, after which the count begins anew. Where
    // there is no shorter increment, any other way is dearer near the end.
    const unsigned int most_iterations =
      (problem.load_step > 0 ? 1 : patience_near_end) * largest_iterations;
    const auto gets_on = [&]() {
      return since_stiffening < largest_iterations ||
             (since_stiffening < most_iterations && is_near(residuals));
    };
    for (; gets_on() && stiffenings < largest_stiffenings; ++since_stiffening)
      {
        longest_step = goes_round(residuals) ? .5 : 1;
        increment.generate(state, problem);
        damping.follow(residuals);
        const Step step =
          newton_step(state, problem, increment.tolerance(), true);
        longest_step = 1;
        residuals.push_back(last_residual);
        switch (step)
          {
            case Step::converged:
              if (!penetration.needs_stiffening(increment.contacts))
                return true;
              stiffen();
              break;
            case Step::failed:
              return false;
            case Step::moved:
              damping.follow_cut(last_cut);
              // What has only been hit in passing needs no stiffness.
              if (last_residual <
                    std::min(stiffening_from * increment.tolerance(),
                             loosest_stiffening) &&
                  !system.motion().moves(state, problem.targets) &&
                  since_stiffening >= least_between &&
                  penetration.needs_stiffening(increment.contacts))
                stiffen();
              break;
          }
      }
    return false;
  }
} // namespace fiberloom
