// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// Newton's steps that the energy judges.

#include <fiberloom/base/rounding.h>
#include <fiberloom/base/scoped_timer.h>

#include <fiberloom/solvers/newton.h>

#include <algorithm>
#include <cmath>

namespace fiberloom
{
  double
  Newton::promise(const Step &step, const double factor)
  {
    const double part = std::min(1., factor);
    return -step.slope * part * (1 - .5 * part);
  }



  Newton::Reached
  Newton::at(const State   &state,
             const Problem &problem,
             const Step    &step,
             const double   factor) const
  {
    ScopedTimer timer(statistics.seconds.assembly);
    Reached     there;
    there.factor = factor;
    there.state  = moved(state, step.increment, factor);
    there.energy = energy(state, there.state, problem);
    return there;
  }



  Newton::Reached
  Newton::search(const State   &state,
                 const Problem &problem,
                 const Step    &step,
                 const double   here)
  {
    Reached    found     = at(state, problem, step, longest(step));
    const auto goes_down = [&]() {
      // Where energies are the same but for rounding, slopes decide.
      return std::abs(found.energy - here) <= rounding * std::abs(here) ?
               dot(residual_at(found.state, problem), step.solution) <=
                 -step.slope :
               found.energy < here;
    };
    unsigned int cuts = 0;
    for (; found.factor > rounding && !goes_down(); ++cuts)
      {
        const double parabola =
          -.5 * step.slope * found.factor * found.factor /
          (found.energy - here - step.slope * found.factor);
        const double cut =
          std::isfinite(parabola) ?
            std::clamp(parabola / found.factor, shortest, longest_cut) :
            shortest;
        found = at(state, problem, step, found.factor * cut);
      }
    found.cuts = cuts;
    return found;
  }



  void
  Newton::lengthen(const State   &state,
                   const Problem &problem,
                   const Step    &step,
                   const double   here,
                   Reached       &found)
  {
    const double furthest = largest_move > 0 ? largest_move : 1;
    while (found.cuts == 0 && 2 * found.factor * step.move < furthest &&
           here - found.energy > -good_model * step.slope * found.factor)
      {
        Reached longer = at(state, problem, step, 2 * found.factor);
        correct(state, problem, step, longer);
        if (!(longer.energy < found.energy))
          return;
        found = std::move(longer);
      }
  }



  void
  Newton::descend(State &state, const Problem &problem, const Step &step)
  {
    const double here  = energy(state, state, problem);
    const double full  = longest(step);
    Reached      found = search(state, problem, step, here);
    const Step  *taken = &step;
    if (found.factor < shortest && other.move > 0)
      {
        // Other contacts close on the way than predicted.
        Reached instead = search(state, problem, other, here);
        if (instead.energy < found.energy)
          {
            found = std::move(instead);
            taken = &other;
          }
      }
    correct(state, problem, *taken, found);
    lengthen(state, problem, *taken, here, found);

    const double promised = promise(*taken, found.factor);
    const double actual   = promised > 0 ? (here - found.energy) / promised : 0;
    is_near_enough        = problem.near_enough > 0 && moving.are_all() &&
                     promise(*taken) < problem.near_enough * here;
    // Where fibers have bounds, these see to it that no step is too long.
    if (found.cuts > 1 || (!is_bounded && actual < poor_model))
      damping = std::max(largest_change * damping, least_damping);
    else if (found.cuts == 0 && full == 1 &&
             (is_bounded || actual > good_model))
      damping = damping > least_damping ? damping / largest_change : 0;
    trusted = found.factor >= 1 && actual > poor_model &&
              (!is_bounded || !is_exact || actual < 1 + trusted_error);
    ends_exactly =
      residual < tolerance(problem) || (is_exact && moving.are_all());
    last_factor = found.factor;
    if (moving.are_all() && is_bounded && !problem.rule.friction)
      choose_moving(found.state.q - state.q);
    state.q          = std::move(found.state.q);
    state.placements = std::move(found.state.placements);
  }



  void
  Newton::choose_moving(const DofVector &way)
  {
    Eigen::VectorXd increment = Eigen::VectorXd::Zero(system.layout().n_dofs());
    increment.head(way.size()) = way;
    moving.choose(system.motion().largest_moves(increment), poor_model);
    if (!moving.are_all() && !of_few)
      of_few =
        std::make_unique<LinearSolver>(system, Preconditioning::double_factor);
  }



  std::vector<double>
  Newton::residual_at(const State &there, const Problem &problem)
  {
    ScopedTimer                 timer(statistics.seconds.assembly);
    std::vector<ContactElement> contacts = increment.contacts;
    system.assemble_residual(there, problem.targets, contacts);
    std::vector<double> residual = system.free_residual();
    moving.restrict(residual);
    return residual;
  }



  void
  Newton::correct(const State   &state,
                  const Problem &problem,
                  const Step    &step,
                  Reached       &there)
  {
    Eigen::VectorXd total = there.factor * step.increment;
    for (unsigned int k = 0; k < most_corrections; ++k)
      {
        // What the linear model of the step does not explain.
        std::vector<double> defect = residual_at(there.state, problem);
        const double        before = dot(defect, defect);
        std::vector<double> solution;
        for (unsigned int i = 0; i < defect.size(); ++i)
          defect[i] = there.factor * step.response[i] - gradient[i] - defect[i];
        moving.restrict(defect);
        LinearSolver::Outcome outcome;
        {
          ScopedTimer timer(statistics.seconds.linear_solver);
          // Without friction all is in the energy, and what a correction
          // leaves is left to the next step.
          const double tolerance =
            problem.rule.friction ? forcing() : poor_model;
          if (!solver().solve_again({system.matrix(), defect, tolerance},
                                    solution,
                                    outcome))
            break;
        }
        add(statistics, outcome);
        const auto is_nearer = [&](const State &next) {
          const std::vector<double> left = residual_at(next, problem);
          return dot(left, left) < before;
        };
        Step correction;
        correction.increment = system.gather(solution);
        correction.move = system.motion().largest_move(correction.increment);
        if (!(correction.move < (largest_move > 0 ? largest_move : 1e300)))
          break;
        double part = 1;
        for (; part >= poor_model; part *= longest_cut)
          {
            Step way;
            way.increment = total + part * correction.increment;
            Reached next  = at(state, problem, way, 1);
            // Of energies that are the same but for rounding, forces decide.
            const bool is_same = std::abs(next.energy - there.energy) <=
                                 rounding * std::abs(there.energy);
            if (is_same ? !is_nearer(next.state) :
                          !(next.energy < there.energy))
              continue;
            there.energy = next.energy;
            there.state  = std::move(next.state);
            total        = way.increment;
            break;
          }
        if (part < poor_model)
          return;
      }
  }
} // namespace fiberloom
