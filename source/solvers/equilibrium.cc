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
    // Of the linear systems: Newton's method converges by exact steps, a damped
    // one does not.
    constexpr double exact_linear = 1e-9, damped_linear = 1e-4;

    // Where the tangent is not positive definite, on its diagonal over E r.
    constexpr double first_shift = 1e-4;

    constexpr unsigned int largest_halvings = 8;
  } // namespace



  Equilibrium::Equilibrium(const Parameters &parameters,
                           ContactGenerator &generator,
                           System           &system,
                           StageStatistics  &statistics,
                           Watch             watch)
    : mesh(system.fiber_mesh())
    , parameters(parameters)
    , generator(generator)
    , system(system)
    , linear_solver(system, parameters.solver.linear_solver)
    , statistics(statistics)
    , watch(std::move(watch))
    , increment(mesh, parameters.solver, generator, system, statistics)
    , by_newton(increment,
                linear_solver,
                parameters.solver.largest_move,
                this->watch)
    , penetration(mesh, parameters.contact, system.motion())
  {}



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
        moved.fibers     = state.fibers;
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
  Equilibrium::newton_step(State           &state,
                           const Problem   &problem,
                           const double     damping,
                           const StepLength length)
  {
    increment.assemble(state, problem);
    const double scale    = increment.scale(problem);
    const double residual = system.residual_norm() / scale;
    const bool   moves    = system.motion().moves(state, problem.targets);
    watch({residual, damping, last_factor});
    const double allowed =
      std::max(increment.tolerance(), system.rounding_force() / scale);
    if (!moves && residual < allowed)
      {
        folded = mesh.is_folded(state.q, state.fibers);
        return folded ? Step::failed : Step::converged;
      }
    if (!std::isfinite(residual))
      return Step::failed;

    // Without one, neither its curvature nor its decrease says anything.
    const bool            has_potential = system.has_potential(problem.targets);
    std::vector<double>   solution;
    LinearSolver::Outcome outcome;
    {
      ScopedTimer  timer(statistics.seconds.linear_solver);
      const double scale = system.stiffness_scale();
      outcome =
        linear_solver.solve({system.matrix(),
                             system.right_hand_side(),
                             damping > 0 ? damped_linear : exact_linear},
                            state.q,
                            {damping * scale,
                             first_shift * scale,
                             has_potential ?
                               LinearSolver::Indefinite::shifted :
                               LinearSolver::Indefinite::accepted},
                            solution);
    }
    ++statistics.newton_iterations;
    add(statistics, outcome);
    last_negative_pivots = outcome.negative_pivots;

    const Eigen::VectorXd step = system.gather(solution);
    const double          move = system.motion().largest_move(step);
    if (!std::isfinite(move))
      return Step::failed;
    double factor = 1;
    if (const double limit = parameters.solver.largest_move;
        limit > 0 && !increment.contacts.empty())
      {
        factor = limit / std::max(move, limit);
        if (moves)
          factor =
            std::min(factor,
                     limit / std::max(limit,
                                      system.motion().largest_prescribed_move(
                                        state, problem.targets)));
      }
    if (length == StepLength::by_energy && !moves && has_potential)
      {
        ScopedTimer timer(statistics.seconds.assembly);
        factor = search_along(state, problem, step, factor);
      }
    last_factor = factor;
    system.motion().advance(state, step, factor);
    return Step::moved;
  }



  bool
  Equilibrium::newton(State &state, const Problem &problem)
  {
    for (unsigned int i = 0; i < parameters.solver.largest_newton_iterations;
         ++i)
      switch (newton_step(state,
                          problem,
                          0,
                          i >= parameters.solver.line_search_from ?
                            StepLength::by_energy :
                            StepLength::whole))
        {
          case Step::converged:
            return true;
          case Step::failed:
            return false;
          case Step::moved:
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
      increment.regenerate(state, problem);
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
          too_far = mesh.is_folded(state.q, state.fibers);
          if (!too_far)
            {
              increment.regenerate(state, problem);
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
    if (n_yardsticks == 0)
      time_yardstick();
    return keeps_sides(state, problem);
  }



  bool
  Equilibrium::solve_again(State &state, const Problem &problem)
  {
    folded = passed = false;
    increment.regenerate(state,
                         is_nested(problem) ? problem : following(problem));
    return solve_from_contacts(state, problem) && keeps_sides(state, problem);
  }



  bool
  Equilibrium::keeps_sides(const State &state, const Problem &problem)
  {
    // Only a weave turns sides, as its pattern says.
    passed =
      !problem.rule.from_above && generator.may_pass(problem.before.q, state.q);
    return !passed;
  }



  void
  Equilibrium::evaluate(State &state, const Problem &problem)
  {
    increment.generate(state, problem);
    increment.measure(state, problem);
  }



  Problem
  Equilibrium::following(const Problem &problem)
  {
    Problem following            = problem;
    following.rule.points_follow = true;
    return following;
  }



  bool
  Equilibrium::is_nested(const Problem &problem) const
  {
    return parameters.solver.loops == Loops::nested ||
           problem.rule.from_above || !system.has_potential(problem.targets);
  }



  bool
  Equilibrium::find(State &state, const Problem &problem)
  {
    folded = false;
    return extrapolate(state,
                       is_nested(problem) ? problem : following(problem)) &&
           solve_from_contacts(state, problem);
  }



  bool
  Equilibrium::solve_from_contacts(State &state, const Problem &problem)
  {
    if (is_nested(problem))
      return solve_nested(state, problem);
    if (increment.contacts.empty())
      {
        if (!newton(state, problem))
          return false;
        // What moved without contact may have come to touch.
        increment.generate(state, following(problem));
        if (increment.contacts.empty())
          return true;
      }
    return solve_by_newton(state, problem);
  }



  bool
  Equilibrium::solve_by_newton(State &state, const Problem &problem)
  {
    if (!by_newton.solve(state,
                         following(problem),
                         parameters.solver.largest_loop_iterations,
                         &penetration))
      return false;
    last_negative_pivots = by_newton.negative_pivots();
    folded               = mesh.is_folded(state.q, state.fibers);
    if (folded)
      return false;
    time_yardstick();
    return true;
  }



  bool
  Equilibrium::solve_from(State &state, const Problem &problem)
  {
    increment.generate(state, following(problem));
    return solve_by_newton(state, problem);
  }



  void
  Equilibrium::time_yardstick()
  {
    // A machine with other work on it is not always as fast: the mean counts.
    if (parameters.solver.benchmark)
      statistics.seconds.yardstick +=
        (LinearSolver::time_double_factorization(system.matrix()) -
         statistics.seconds.yardstick) /
        ++n_yardsticks;
  }



  bool
  Equilibrium::approach(State             &state,
                        const Problem     &problem,
                        const unsigned int n,
                        const double       stiffer)
  {
    increment.generate(state, problem);
    if (increment.contacts.empty())
      return newton(state, problem);
    for (ContactElement &contact : increment.contacts)
      {
        contact.friction_limit /= stiffer;
        contact.normal_force_before /= stiffer;
      }
    return by_newton.solve(state, problem, n);
  }



  bool
  Equilibrium::solve_nested(State &state, const Problem &problem)
  {
    for (unsigned int pass = 0; pass < parameters.solver.largest_contact_passes;
         ++pass)
      {
        if (pass > 0)
          increment.generate(state, problem);
        bool settled = false;
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
                  return true;
                break;
              }
            if (!newton(state, problem))
              return false;
          }
        if (!settled)
          return false;
        if (increment.contacts.empty())
          {
            // What moved without contact may have come to touch.
            increment.generate(state, problem);
            if (increment.contacts.empty())
              return true;
          }
        if (penetration.needs_stiffening(increment.contacts))
          penetration.stiffen(increment.contacts, state.contact.zones);
      }
    return false;
  }



  void
  Equilibrium::iterate(State             &state,
                       const Problem     &problem,
                       const unsigned int n,
                       const double       damping)
  {
    for (unsigned int i = 0; i < n; ++i)
      {
        increment.generate(state, problem);
        if (newton_step(state, problem, damping, StepLength::by_energy) !=
            Step::moved)
          return;
      }
  }
} // namespace fiberloom
