// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// What the damping of the damped loop makes of residuals, steps and forces: it
// stays where residuals fall, decays where they creep, comes back where that
// throws fibers, twice as late the next time, and goes through cycles where
// steps go on changing forces.

#include <fiberloom/solvers/damping.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <vector>

#include "checks.h"
#include "sample_fibers.h"

using namespace fiberloom;

namespace
{
  constexpr double least = 2e-3;

  /** Over the least, before the step that follows each of the residuals. */
  std::vector<double>
  parts(Damping &damping, const std::vector<double> &residuals)
  {
    std::vector<double> parts, so_far;
    for (const double residual : residuals)
      {
        so_far.push_back(residual);
        damping.follow(so_far);
        parts.push_back(damping.over_Er() / least);
      }
    return parts;
  }

  void
  check_creep(Checks &checks, Damping &damping)
  {
    damping.reset(least);
    std::vector<double> falling(30);
    for (unsigned int i = 0; i < falling.size(); ++i)
      falling[i] = std::pow(.9, i);
    const auto usual = parts(damping, falling);
    checks.that("usual while residuals fall",
                *std::min_element(usual.begin(), usual.end()) == 1);

    damping.reset(least);
    std::vector<double> creeping(8, .05);
    creeping.push_back(.2);                   // thrown
    creeping.insert(creeping.end(), 12, .05); // creeps once more
    const auto found = parts(damping, creeping);
    checks.equal("before creep is known", found[3], 1);
    checks.equal("once it is", found[4], .5);
    checks.equal("three iterations later", found[7], 1. / 16);
    checks.equal("thrown", found[8], 1);
    checks.equal("creep for seven iterations then", found[16], 1);
    checks.equal("for eight", found[17], .5);

    damping.reset(least);
    damping.follow_reactions({BodyVector::Ones()}, true, .1);
    checks.that("none lost where forces are balanced already",
                parts(damping, std::vector<double>(20, .05)).back() == 1);
  }

  void
  check_cycles(Checks &checks, Damping &damping)
  {
    std::vector<double> residuals{.4, .2};
    residuals.insert(residuals.end(), 7, 2.);

    double     force = 1;
    const auto rests = [&](const double factor, const bool balanced = true) {
      force *= factor;
      return damping.follow_reactions({force * BodyVector::Ones()},
                                      balanced,
                                      .1);
    };

    damping.reset(least);
    rests(1);
    checks.that("steady forces are at rest", rests(1));
    checks.that("those that change by 2 % a step are not", !rests(1.02));
    checks.equal("no cycle yet", parts(damping, residuals)[1], 1);

    const auto parts_after = [&](const std::vector<double> &factors) {
      damping.reset(least);
      rests(1, false);
      for (const double factor : factors)
        rests(factor);
      return parts(damping, residuals);
    };
    checks.equal("nor after four that are not in a row",
                 parts_after({1.02, 1.02, 1.02, 1., 1.02})[1],
                 1);
    checks.equal("nor where they decay fast enough",
                 parts_after({1.02, 1.018, 1.015, 1.013, 1.011})[1],
                 1);

    const auto found = parts_after({1.02, 1.02, 1.02, 1.02});
    checks.equal("far from balance", found[0], 1);
    checks.equal("a cycle begins", found[1], 1. / 4);
    checks.equal("with shifts as usual", damping.usual_over_Er() / least, 1);
    checks.equal("goes on, come what may", found[4], 1. / 256);
    checks.equal("ends with the usual damping", found[8], 1);
    checks.that("is over only with the next residual", !rests(1));
    residuals.push_back(.2);
    for (unsigned int i = 0; i < 3; ++i)
      {
        damping.follow(residuals);
        checks.equal("then the usual damping until there is balance",
                     damping.over_Er() / least,
                     1);
        checks.that("in which nothing rests", !rests(1.02, false));
      }
    damping.follow(residuals);
    checks.that("6 % from one cycle to the next are not rest", !rests(1));
    damping.follow(residuals);
    checks.equal("the next begins", damping.over_Er() / least, 1. / 4);
    checks.that("within the next nothing is", !rests(1));
    for (unsigned int i = 0; i < 8; ++i)
      damping.follow(residuals);
    checks.that("2 % from one cycle to the next are", rests(1.02));
    for (unsigned int i = 0; i < 9; ++i)
      damping.follow(residuals);
    for (unsigned int i = 0; i < 10; ++i)
      {
        checks.that("without balance none rests", !rests(1, false));
        damping.follow(residuals);
      }
    checks.that("and the next cycle begins", damping.over_Er() < .5 * least);
  }

  void
  check_fibers(Checks &checks, const FiberMesh &mesh, Damping &damping)
  {
    Eigen::VectorXd step = Eigen::VectorXd::Zero(9 * mesh.n_nodes());
    step[9 * mesh.lines()[1].first_node] = .2 * mesh.lines()[1].radius;
    damping.reset(least);
    damping.remember(step);
    damping.follow_fibers(0);
    const auto blocks = damping.of_blocks(mesh.n_nodes(), 1);
    checks.equal("of a fiber that stays", blocks[0] / least, 1);
    checks.equal("of one that goes far",
                 blocks[mesh.lines()[1].first_node] / least,
                 4);
    checks.equal("of a step that does not go back",
                 damping.relaxation(step),
                 1);
    checks.equal("of one that goes all the way back",
                 damping.relaxation(-step),
                 .5);
  }
} // namespace



int
main()
{
  std::ofstream   output("output");
  Checks          checks(output);
  const FiberMesh mesh(
    loose_fibers({straight_fiber({0, 0, 0}, {10, 0, 0}, 4),
                  straight_fiber({0, 5, 0}, {10, 5, 0}, 4)}));
  Damping damping(mesh);
  check_creep(checks, damping);
  check_cycles(checks, damping);
  check_fibers(checks, mesh, damping);
}
