// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/rounding.h>
#include <fiberloom/base/scoped_timer.h>

#include <fiberloom/contact/contact_potential.h>

#include <fiberloom/solvers/contact_prediction.h>
#include <fiberloom/solvers/newton.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace fiberloom
{
  namespace
  {
    /** Without friction fibers are loose enough to buckle. */
    Curvature
    definite(const Problem &problem)
    {
      return problem.rule.friction ? Curvature::positive : Curvature::convex;
    }
  } // namespace



  Newton::Newton(Increment    &increment,
                 LinearSolver &linear_solver,
                 const double  largest_move,
                 Watch         watch)
    : mesh(increment.mesh)
    , system(increment.system)
    , linear_solver(linear_solver)
    , statistics(increment.statistics)
    , increment(increment)
    , largest_move(largest_move)
    , watch(std::move(watch))
    , bounds(mesh, system, largest_move)
    , moving(mesh, system)
  {}



  bool
  Newton::solve(State             &state,
                const Problem     &problem,
                const unsigned int most,
                const Penetration *penetration)
  {
    // However this ends, what comes next sees all fibers.
    struct AtEnd
    {
      ~AtEnd()
      {
        moving.release();
      }
      MovingFibers &moving;
    } const at_end{moving};
    begin();
    bounds.release();
    of_few.reset();
    unsigned int n       = 0; // iterations with this stiffness
    const auto   stiffen = [&]() {
      if (penetration == nullptr ||
          !penetration->needs_stiffening(increment.contacts))
        return false;
      penetration->stiffen(increment.contacts, state.contact.zones);
      begin();
      n = 0;
      return true;
    };
    for (;;)
      {
        refresh(state, problem);
        const bool moves = system.motion().moves(state, problem.targets);
        if (!moving.are_all())
          go_on_with_few(state, problem);
        assemble(state,
                 problem,
                 !moves && is_exact_worth_it(problem) ? Curvature::exact :
                                                        definite(problem));
        restrict_to_moving();
        if (moving.are_all())
          measure(problem);
        watch({residual, damping, last_factor});
        if (!moves && n > 0 && depths_are_known(problem) && stiffen())
          continue;
        if (!moves && is_balanced(problem) && is_at_rest(state, problem))
          {
            if (stiffen())
              continue;
            if (ends_exactly || problem.rule.friction ||
                problem.near_enough > 0)
              return true;
            // Quadratic at the end, if the Hessian is definite there.
            ends_exactly = trusted = true;
          }
        Step step;
        if (n == most || !std::isfinite(residual))
          return false;
        ++n;
        ++statistics.newton_iterations;
        is_bounded = largest_move > 0 && !moves &&
                     (!problem.rule.friction || problem.is_near);
        solve_first(state, problem, step);
        limits_are_new = !moves && take_coupled_step(state, problem);
        if (limits_are_new)
          continue;
        if (!predict(state, problem, step))
          return false;
        if (moves)
          follow_motion(state, problem, step);
        else
          descend(state, problem, step);
      }
  }



  double
  Newton::tolerance(const Problem &problem) const
  {
    // All that follows starts from there, and is worth another iteration.
    return problem.is_first ?
             std::max(increment.tolerance() / largest_change,
                      system.rounding_force() / increment.scale(problem)) :
             increment.tolerance();
  }



  bool
  Newton::is_balanced(const Problem &problem) const
  {
    return residual < tolerance(problem) || is_near_enough;
  }



  bool
  Newton::depths_are_known(const Problem &problem) const
  {
    // From rest to rest no zone is to remember how the iterations went.
    return residual < (problem.is_first ?
                         poor_model :
                         largest_change * increment.tolerance());
  }



  void
  Newton::begin()
  {
    generated_at.resize(0);
    trusted        = true;
    damping        = 0;
    coupled_below  = 1;
    coupled_since  = 0;
    residual       = 1e300;
    lagged         = 0;
    limits_are_new = false;
    is_near_enough = false;
    ends_exactly   = false;
    exact_below    = 1e300;
    moving.release();
  }



  void
  Newton::measure(const Problem &problem)
  {
    residual = increment.residual(problem);
    lagged   = std::max(lagged, residual);
  }



  void
  Newton::refresh(State &state, const Problem &problem)
  {
    const bool begins = generated_at.size() == 0;
    const bool halved = has_halved(state, problem);
    if (halved)
      {
        lagged         = 0;
        limits_are_new = true;
      }
    if (begins ||
        system.motion().largest_move(state.q - generated_at) > stale_after)
      {
        // Far from balance normal forces say nothing of friction's limits.
        if (begins || (problem.rule.friction && !halved))
          {
            increment.regenerate(state, problem);
            limits_are_new = false;
          }
        else
          increment.generate(state, problem);
        generated_at = state.q;
        return;
      }
    if (halved)
      increment.update_normals(state, problem);
    ScopedTimer timer(statistics.seconds.assembly);
    // Points may have slid onto other elements.
    const DofVector q = mesh.with_images(state.q);
    for (ContactElement &contact : increment.contacts)
      if (contact.following != ContactElement::Points::fixed)
        follow_points(contact, mesh.with_images(), q);
    system.reinit(increment.contacts);
  }



  bool
  Newton::has_halved(const State &state, const Problem &problem)
  {
    if (!problem.rule.friction || limits_are_new || lagged == 0)
      return false;
    const double reached = increment.measure(state, problem);
    lagged               = std::max(lagged, reached);
    return 2 * reached < lagged;
  }



  bool
  Newton::is_exact_worth_it(const Problem &problem) const
  {
    return trusted && (!moving.are_all() ||
                       (residual < exact_below &&
                        (!problem.is_first || residual < poor_model)));
  }



  void
  Newton::go_on_with_few(const State &state, const Problem &problem)
  {
    system.restrict_to({});
    increment.measure(state, problem);
    measure(problem);
    if (moving.are_worth_it(poor_model, largest_change))
      return;
    moving.release();
    system.reinit(increment.contacts);
  }



  bool
  Newton::is_at_rest(State &state, const Problem &problem)
  {
    moving.release();
    increment.generate(state, problem);
    generated_at = state.q;
    assemble(state, problem, Curvature::exact);
    lagged = 0;
    measure(problem);
    limits_are_new = true;
    return is_balanced(problem);
  }



  void
  Newton::assemble(const State    &state,
                   const Problem  &problem,
                   const Curvature curvature)
  {
    is_exact = curvature == Curvature::exact;
    system.set_curvature(curvature);
    increment.assemble(state, problem);
    gradient = system.right_hand_side();
  }



  void
  Newton::restrict_to_moving()
  {
    moving.restrict_matrix();
    moving.restrict(gradient);
  }



  State
  Newton::moved(const State           &state,
                const Eigen::VectorXd &increment,
                const double           factor) const
  {
    State moved;
    moved.q          = state.q;
    moved.fibers     = state.fibers;
    moved.placements = state.placements;
    system.motion().advance(moved, increment, factor);
    return moved;
  }



  double
  Newton::energy(const State   &from,
                 const State   &at,
                 const Problem &problem) const
  {
    return system.energy(at, increment.contacts) -
           system.load_work(problem.targets, from, at);
  }



  double
  Newton::longest(const Step &step) const
  {
    return largest_move > 0 ? largest_move / std::max(largest_move, step.move) :
                              1;
  }



  bool
  Newton::solve_linear(const State                   &state,
                       const double                   damping,
                       const LinearSolver::Indefinite indefinite,
                       Step                          &step)
  {
    LinearSolver::Outcome outcome;
    std::vector<double>   right_hand_side = system.right_hand_side();
    moving.restrict(right_hand_side);
    {
      ScopedTimer  timer(statistics.seconds.linear_solver);
      const double scale = system.stiffness_scale();
      outcome = solver().solve({system.matrix(), right_hand_side, forcing()},
                               state.q,
                               {damping * scale,
                                std::max(least_damping, damping) * scale,
                                indefinite},
                               step.solution);
    }
    add(statistics, outcome);
    if (is_exact && moving.are_all())
      last_negative_pivots = outcome.negative_pivots;
    if (outcome.negative_pivots != 0 &&
        indefinite == LinearSolver::Indefinite::refused)
      return false;
    complete(step);
    return true;
  }



  double
  Newton::forcing() const
  {
    return std::clamp(shortest * residual, linear_tolerance, rough_tolerance);
  }



  void
  Newton::complete(Step &step) const
  {
    step.increment = system.gather(step.solution);
    step.response  = system.matrix().times(step.solution);
    step.slope     = -dot(gradient, step.solution);
    step.move      = system.motion().largest_move(step.increment);
  }



  Newton::Step
  Newton::bounded(const Step &step) const
  {
    Step bounded = step;
    if (is_bounded && step.move > largest_move)
      {
        bounds.cut(bounded.solution, step.increment);
        complete(bounded);
      }
    return bounded;
  }



  double
  Newton::dot(const std::vector<double> &a, const std::vector<double> &b) const
  {
    const double sum = std::inner_product(a.begin(), a.end(), b.begin(), 0.);
    return dealii::Utilities::MPI::sum(sum, system.layout().communicator());
  }



  void
  Newton::solve_first(const State &state, const Problem &problem, Step &step)
  {
    using Indefinite = LinearSolver::Indefinite;
    // Held fibers have so much more that low-rank blocks may leave this out.
    const double least = is_bounded && bounds.hold_any() ?
                           std::max(damping, least_damping) :
                           damping;
    if (is_bounded)
      bounds.add_to_matrix();
    if (is_exact && !solve_linear(state, least, Indefinite::refused, step))
      {
        if (moving.are_all() && !problem.rule.friction)
          exact_below = longest_cut * residual;
        assemble(state, problem, definite(problem));
        restrict_to_moving();
        if (is_bounded)
          bounds.add_to_matrix();
      }
    else if (is_exact && moving.are_all())
      exact_below = 1e300;
    if (!is_exact)
      solve_linear(state, least, Indefinite::shifted, step);
  }



  double
  Newton::hold(const Step &step)
  {
    if (is_bounded)
      {
        bounds.hold(gradient, step.solution, step.increment);
        return 0;
      }
    // As if all moved along the step, like one spring.
    return (step.move / largest_move - 1) * -step.slope /
           dot(step.solution, step.solution) / system.stiffness_scale();
  }



  bool
  Newton::predict(const State &state, const Problem &problem, Step &step)
  {
    other             = Step();
    const bool is_far = largest_move > 0 && step.move > largest_move;

    ContactPrediction prediction(
      mesh, system, increment, problem, ContactPrediction::Kind::closing);
    const auto predicts = [&](const Step &step) {
      const State ahead = moved(state, step.increment, longest(step));
      // What stores little changes little of the step, and costs a factor. With
      // friction all forces count, as its limits are to follow them.
      const double little =
        problem.rule.friction ? 0 : poor_model * promise(step);
      ScopedTimer timer(statistics.seconds.assembly);
      if (!prediction.add_stiffness(state, ahead, little))
        return false;
      moving.restrict_matrix();
      return true;
    };
    // What is far closes other contacts in the next iteration.
    const unsigned int most = is_far ? 1 : most_predictions;
    for (unsigned int k = 0; k < most && std::isfinite(step.move); ++k)
      {
        Step       cut    = bounded(step);
        const bool closes = predicts(cut);
        if (!closes && !is_far)
          break;
        const double more = is_far ? hold(step) : 0;
        // Contacts that are predicted pull as well as push: what they make of
        // the step still has to go down.
        Step next;
        solve_linear(state, more, LinearSolver::Indefinite::shifted, next);
        if (!(next.slope < 0))
          break;
        if (k == 0)
          other = std::move(cut);
        step = std::move(next);
      }
    if (!std::isfinite(step.move))
      return false;
    if (is_bounded)
      bounds.prepare_next(gradient, step.solution, step.increment);
    step = bounded(step);
    return true;
  }



  void
  Newton::follow_motion(State &state, const Problem &problem, const Step &step)
  {
    const double prescribed =
      system.motion().largest_prescribed_move(state, problem.targets);
    last_factor =
      largest_move > 0 ? largest_move / std::max(largest_move, prescribed) : 1;
    last_factor = std::min(last_factor, longest(step));
    system.motion().advance(state, step.increment, last_factor);
  }
} // namespace fiberloom
