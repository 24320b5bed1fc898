// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// Newton's steps whose friction limits follow the normal forces.

#include <fiberloom/base/scoped_timer.h>

#include <fiberloom/solvers/contact_prediction.h>
#include <fiberloom/solvers/newton.h>

#include <algorithm>
#include <cmath>

namespace fiberloom
{
  bool
  Newton::find_coupled_step(const State   &state,
                            const Problem &problem,
                            Step          &step)
  {
    ContactPrediction prediction(
      mesh, system, increment, problem, ContactPrediction::Kind::all);
    const auto predicts = [&]() {
      const State ahead = moved(state, step.increment, longest(step));
      ScopedTimer timer(statistics.seconds.assembly);
      return prediction.add_stiffness(state, ahead);
    };
    last_krylov      = 0;
    factor_is_behind = true;
    bool found       = solve_coupled(gradient, step);
    for (unsigned int k = 0; k < most_predictions && found && predicts(); ++k)
      {
        factor_is_behind = true;
        found            = solve_coupled(system.right_hand_side(), step);
      }
    return found;
  }



  bool
  Newton::take_coupled_step(State &state, const Problem &problem)
  {
    if (!problem.rule.friction || !limits_are_new || !is_exact || damping > 0 ||
        !(coupled_since > 0 || residual < coupled_below))
      return false;
    Step step;
    if (find_coupled_step(state, problem, step))
      {
        const auto kept   = increment.all_contacts();
        double     factor = longest(step);
        // Shorter steps only creep; one that the energy judges gets past.
        for (; factor >= longest_cut; factor *= longest_cut)
          {
            CoupledStep there;
            there.state    = state;
            there.residual = residual;
            if (!reach_coupled(there, problem, step, factor))
              continue;
            correct_coupled(there, problem);
            if (!(there.residual < residual))
              continue;
            if (is_bounded)
              bounds.prepare_next(gradient, step.solution, step.increment);
            state        = std::move(there.state);
            generated_at = state.q;
            if (coupled_since == 0)
              coupled_since = residual;
            residual = lagged = there.residual;
            trusted           = true;
            last_factor       = factor;
            return true;
          }
        increment.take_back(kept);
      }
    assemble(state, problem, Curvature::exact);
    if (coupled_since > 0)
      coupled_below = coupled_since;
    coupled_since = 0;
    return false;
  }



  bool
  Newton::reach_coupled(CoupledStep   &there,
                        const Problem &problem,
                        const Step    &step,
                        const double   factor)
  {
    const double shorter = 1 - poor_model * factor, before = there.residual;
    system.motion().advance(there.state, step.increment, factor);
    there.residual = increment.measure_anew(there.state, problem);
    if (there.residual < increment.tolerance())
      return true;
    std::vector<double> defect = system.free_residual();
    for (double &value : defect)
      value = -value;
    return solve_coupled(defect, there.next) &&
           (there.next.move < shorter * step.move ||
            (there.residual < shorter * before &&
             there.next.move < largest_move));
  }



  void
  Newton::correct_coupled(CoupledStep &there, const Problem &problem)
  {
    while (there.residual > increment.tolerance() &&
           there.next.move < largest_move)
      {
        const auto  kept = increment.all_contacts();
        CoupledStep next;
        next.state    = there.state;
        next.residual = there.residual;
        if (!reach_coupled(next, problem, there.next, 1) ||
            !(next.residual < there.residual))
          {
            increment.take_back(kept);
            return;
          }
        there = std::move(next);
      }
  }



  bool
  Newton::solve_coupled(const std::vector<double> &right_hand_side, Step &step)
  {
    LinearSolver::Outcome outcome;
    bool                  found;
    {
      ScopedTimer timer(statistics.seconds.linear_solver);
      // The one iteration of a new factor costs less than so many of this one.
      if (factor_is_behind && last_krylov > largest_change)
        {
          linear_solver.factorize(system.matrix(), generated_at, outcome);
          factor_is_behind = false;
        }
      found = linear_solver.solve_coupled({system.matrix(),
                                           right_hand_side,
                                           rough_tolerance},
                                          step.solution,
                                          outcome);
    }
    last_krylov = outcome.iterations;
    add(statistics, outcome);
    step.increment = system.gather(step.solution);
    step.move      = system.motion().largest_move(step.increment);
    return found && std::isfinite(step.move);
  }
} // namespace fiberloom
