// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/solvers/damping.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace fiberloom
{
  namespace
  {
    // Newton steps cut below the first part of their length ask for more
    // damping, beyond the second one for less.
    constexpr double short_step = .3, long_step = .7;
    constexpr double growth = 4, decay = .5;

    // Fibers that go further in a step, over the radius, than other fibers may
    // be away get more, each for itself.
    constexpr double far_move = .1, largest_of_line = 64;

    // Frozen normals, behind the tangent, can make steps swing to and fro:
    // those that go back by more than this part of the last one are shortened.
    constexpr double overshoot = .5;

    // Damping that only makes soft fibers creep decays down to this part of the
    // least, until a residual grows by the second factor: fibers were thrown.
    constexpr double quiet_part = 1e-3, thrown = 2;

    // Parts of the least damping in a cycle, which begins where the residual is
    // below the bound: slow motions that many fibers share need little of it,
    // single fibers that were thrown meanwhile come to rest at the end, and in
    // so many more steps if need be.
    constexpr std::array<double, 8> parts_of_cycle{
      {1. / 4, 1. / 16, 1. / 64, 1. / 256, 1. / 256, 1, 1, 1}};
    constexpr double       cycle_from = .3;
    constexpr unsigned int most_waits = 8;

    // What a damped step of a pull may still change of the forces, over the
    // largest one, and over the tolerance that step or a whole cycle: soft
    // fibers give up theirs long after residuals are small. After so many steps
    // in a row that change more than this multiple, their decay tells how many
    // more it takes; more than the last number are a motion that many fibers
    // share.
    constexpr double       largest_drift = .005, drift_over_tolerance = .5;
    constexpr double       slow_drift = 2;
    constexpr unsigned int slow_steps = 4, most_steps = 30;

    // Iterations that tell creep; each throw asks for twice as many.
    constexpr unsigned int first_patience = 4;

    // Forces are nearly in balance, but damping makes soft fibers creep.
    bool
    creeps(const std::vector<double> &residuals, const unsigned int window)
    {
      const unsigned int n = residuals.size();
      return n > window &&
             *std::max_element(residuals.end() - window - 1, residuals.end()) <
               .1 &&
             residuals[n - 1] > .8 * residuals[n - 1 - window];
    }
  } // namespace



  Damping::Damping(const FiberMesh &mesh)
    : mesh(mesh)
  {}



  void
  Damping::reset(const double least)
  {
    this->least = value = least;
    quiet = balanced = cycles = cycle_ended = false;
    patience                                = first_patience;
    position = n_waits = n_slow = 0;
    of_lines.clear();
    last_step.resize(0);
    last_forces.clear();
  }



  std::vector<double>
  Damping::of_blocks(const unsigned int n_blocks, const double stiffness) const
  {
    const double        usual = value * stiffness;
    std::vector<double> blocks(n_blocks, usual);
    for (unsigned int l = 0; l < of_lines.size(); ++l)
      {
        const FiberMesh::Line &line = mesh.lines()[l];
        std::fill_n(blocks.begin() + line.first_node,
                    line.n_nodes(),
                    usual * of_lines[l]);
      }
    return blocks;
  }



  double
  Damping::relaxation(const Eigen::VectorXd &increment) const
  {
    if (value == 0 || last_step.size() != increment.size())
      return 1;
    const double back = -increment.dot(last_step) / last_step.squaredNorm();
    return back > overshoot ? std::max(.5, 1 / (1 + back)) : 1;
  }



  void
  Damping::follow(const std::vector<double> &residuals)
  {
    if (cycles)
      {
        cycle_ended = position == parts_of_cycle.size();
        value       = least;
        if (!cycle_ended && (position > 0 || residuals.back() < cycle_from))
          value *= parts_of_cycle[position++];
        return;
      }
    const bool was_quiet = quiet;
    quiet =
      !balanced && (creeps(residuals, patience) ||
                    (quiet && residuals.back() < thrown * residuals.end()[-2]));
    if (was_quiet && !quiet)
      patience *= 2;
    value = quiet ? std::max(value * decay, quiet_part * least) :
                    std::max(value, least);
  }



  bool
  Damping::follow_reactions(const std::vector<BodyVector> &reactions,
                            const bool                     balanced,
                            const double                   tolerance)
  {
    this->balanced = balanced;
    if (cycles && (!cycle_ended || (!balanced && n_waits++ < most_waits)))
      return false;
    position = n_waits   = 0;
    const double allowed = drift_over_tolerance * tolerance,
                 drift   = change(reactions) /
                         (cycles ? allowed : std::min(largest_drift, allowed));
    n_slow = balanced && drift > slow_drift && !quiet ? n_slow + 1 : 0;
    if (n_slow == 1)
      first_drift = drift;
    // what the steps so far have decayed by, to the power of those to come
    if (!cycles && n_slow >= slow_steps)
      cycles = std::log(drift) * (n_slow - 1) >
               most_steps * std::log(first_drift / drift);
    return balanced && drift < 1;
  }



  double
  Damping::change(const std::vector<BodyVector> &reactions)
  {
    last_forces.resize(reactions.size(), Vector3::Zero());
    double largest = std::numeric_limits<double>::min(), change = 0;
    for (unsigned int b = 0; b < reactions.size(); ++b)
      {
        const Vector3 force = reactions[b].head<3>();
        largest             = std::max(largest, force.norm());
        change              = std::max(change, (force - last_forces[b]).norm());
        last_forces[b]      = force;
      }
    return change / largest;
  }



  void
  Damping::follow_cut(const double cut)
  {
    if (cut < short_step)
      value *= growth;
    else if (cut > long_step && value > least)
      value = std::max(value * decay, least);
  }



  void
  Damping::remember(const Eigen::VectorXd &step)
  {
    last_step = step;
  }



  void
  Damping::follow_fibers(const double ends)
  {
    of_lines.resize(mesh.lines().size(), 1.);
    for (unsigned int l = 0; l < of_lines.size(); ++l)
      {
        const FiberMesh::Line &line = mesh.lines()[l];
        double                 move = 0;
        for (unsigned int n = line.first_node;
             n < line.first_node + line.n_nodes();
             ++n)
          move = std::max(move, last_step.segment<3>(9 * n).norm());
        const double far = (far_move + .5 * ends) * line.radius;
        if (move > far)
          of_lines[l] = std::min(of_lines[l] * growth, largest_of_line);
        else if (move < .5 * far)
          of_lines[l] = std::max(of_lines[l] * decay, 1.);
      }
  }
} // namespace fiberloom
