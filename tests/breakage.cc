// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// Breaking fibers: what a broken element carries and what breaks one, the
// strengths that are drawn, and a bundle against Daniels, "The statistical
// theory of the strength of bundles of threads. I", Proc. R. Soc. A 183, 1945.

#include <fiberloom/beams/breakage.h>

#include <fiberloom/stages/load_settings.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "checks.h"
#include "run_stages.h"

using namespace fiberloom;

namespace
{
  constexpr double radius = .01, E = 1000, nu = .3;
  constexpr double area = M_PI * radius * radius;

  /** Straight along x with an element length of .1, stretched, and bent to a
   * circle about z. */
  BeamElement::Vector
  deformed(const double strain, const double curvature)
  {
    BeamElement::Vector q;
    for (unsigned int a = 0; a < 3; ++a)
      {
        const double angle = .05 * a * (1 + strain) * curvature;
        const double s     = .05 * a * (1 + strain);
        const double x     = curvature > 0 ? std::sin(angle) / curvature : s,
                     y = curvature > 0 ? (1 - std::cos(angle)) / curvature : 0;
        q.segment<9>(9 * a) << x, y, 0, -radius * std::sin(angle),
          radius * std::cos(angle), 0, 0, 0, radius;
      }
    return q;
  }

  void
  check_element(Checks &checks)
  {
    const BeamElement whole(deformed(0, 0), radius, E, nu);
    checks.below("strain of a stretched element",
                 whole.largest_strain(deformed(.02, 0)) - .02,
                 1e-12);
    checks.below("and bent",
                 whole.largest_strain(deformed(.02, 1)) /
                     (.02 + radius * 1.02) -
                   1,
                 .02);

    for (const AxialLaw law :
         {AxialLaw::saint_venant_kirchhoff, AxialLaw::linear})
      {
        const BeamElement broken =
          BeamElement(deformed(0, 0), radius, E, nu, law).broken();
        BeamElement::Vector q = deformed(.5, 0), residual;
        checks.below("force through a broken element over E A",
                     broken.section_forces(q, 1).force.norm() / (E * area),
                     2e-6);
        q = deformed(.5, 3);
        q[4] *= 1.1;
        BeamElement::Matrix tangent;
        broken.residual_and_tangent(q, residual, tangent);
        checks.below("residual",
                     relative_error(residual,
                                    difference_gradient<BeamElement::Vector>(
                                      [&](const auto &x) {
                                        return broken.energy(x);
                                      },
                                      q,
                                      1e-6)),
                     1e-6);
        const auto residual_at = [&](const auto &x) {
          BeamElement::Vector r;
          broken.residual(x, r);
          return r;
        };
        checks.below("tangent",
                     relative_error(tangent,
                                    difference_jacobian<BeamElement::Vector>(
                                      residual_at, q, 1e-6)),
                     1e-6);
        // Plane stress: E11 = .095 of one vector at all nodes alone.
        q = deformed(0, 0);
        for (unsigned int a = 0; a < 3; ++a)
          q.segment<3>(9 * a + 3) *= std::sqrt(1.19);
        checks.below("energy of its sections",
                     broken.energy(q) /
                         (.5 * .1 * area * E / (1 - nu * nu) * .095 * .095) -
                       1,
                     1e-5);
      }
  }

  constexpr unsigned int n_fibers = 61;
  constexpr double       m = 5, s0 = 20, L0 = 3, L = 1;

  Parameters
  bundle()
  {
    Parameters parameters;
    parameters.stages                = {"load"};
    FibersParameters &fibers         = parameters.fibers;
    fibers.arrangement               = Arrangement::bundle;
    fibers.bundle                    = {n_fibers, L, 4};
    fibers.radius                    = {radius};
    fibers.young_modulus             = {E};
    fibers.poisson_ratio             = {0};
    fibers.axial_law                 = AxialLaw::linear;
    fibers.elements_per_fiber        = 2;
    fibers.strength.strength         = s0;
    fibers.strength.weibull_modulus  = m;
    fibers.strength.reference_length = L0;
    parameters.drives                = {{}, {}};
    parameters.drives[0].name        = "start";
    parameters.drives[0].ends        = "all start";
    parameters.drives[1].name        = "end";
    parameters.drives[1].ends        = "all end";
    parameters.drives[1].translation = ".04*t; 0; 0";
    auto &load        = parameters.stage_settings.get<LoadSettings>();
    load.first_step   = .025;
    load.largest_step = .025;
    parameters.solver.error_estimate        = false;
    parameters.contact.friction_coefficient = 0;
    parameters.drive_names                  = {"start", "end"};
    parameters.resolve();
    return parameters;
  }

  void
  check_strengths(Checks &checks)
  {
    Parameters parameters                = bundle();
    parameters.fibers.elements_per_fiber = 40;
    const auto strains                   = [&](const unsigned int seed) {
      parameters.fibers.strength.seed = seed;
      const FiberSet      fibers      = build_fiber_set(parameters);
      const FiberMesh     mesh(fibers);
      const Breakage      breakage(fibers, mesh);
      std::vector<double> strains;
      for (unsigned int e = 0; e < mesh.n_elements(); ++e)
        strains.push_back(breakage.breaking_strain(e));
      return strains;
    };
    const auto one = strains(1);
    checks.that("one seed gives the same strengths", one == strains(1));
    checks.that("another one others", one != strains(2));
    // (l/L0) (s/s0)^m has an exponential distribution of mean 1.
    double mean = 0, square = 0;
    for (const double strain : one)
      {
        const double x = L / 40 / L0 * std::pow(E * strain / s0, m);
        mean += x / one.size();
        square += x * x / one.size();
      }
    const double n = one.size();
    checks.below("mean by Weibull in deviations", (mean - 1) * std::sqrt(n), 3);
    checks.below("mean square in deviations",
                 (square - 2) * std::sqrt(n / 20),
                 3);
  }

  /** Of a bundle of which each fiber breaks at one of @p strains . */
  double
  exact_force(const std::vector<double> &strains, const double strain)
  {
    return std::count_if(strains.begin(),
                         strains.end(),
                         [strain](const double s) { return s >= strain; }) *
           E * area * strain;
  }

  /** Forces by strain, at the end of each increment. */
  std::vector<std::pair<double, double>>
  pull(const Parameters &parameters, Checks &checks)
  {
    std::vector<std::pair<double, double>> forces;
    const FiberSet                         fibers = build_fiber_set(parameters);
    const FiberMesh                        mesh(fibers);
    run_stages(parameters, fibers, [&](const IncrementReport &report) {
      double force = 0;
      for (const auto &[column, value] : report.curve)
        if (column.name == "force_end")
          force = value;
      forces.emplace_back(.04 * report.state.load / L, force);
      if (report.last)
        {
          std::vector<unsigned int> times(n_fibers);
          for (const auto &entry : report.state.fibers.breaks)
            ++times[mesh.fiber_of_element(entry.first)];
          checks.equal("a fiber breaks at most so often",
                       *std::max_element(times.begin(), times.end()),
                       1);
        }
    });
    return forces;
  }

  void
  check_bundle(Checks &checks)
  {
    const Parameters    parameters = bundle();
    const FiberSet      fibers     = build_fiber_set(parameters);
    const FiberMesh     mesh(fibers);
    const Breakage      breakage(fibers, mesh);
    std::vector<double> strains;
    for (unsigned int f = 0; f < n_fibers; ++f)
      strains.push_back(std::min(breakage.breaking_strain(2 * f),
                                 breakage.breaking_strain(2 * f + 1)));

    // By Daniels: the share that holds, and where the force is largest.
    const auto holds = [](const double strain) {
      return std::exp(-L / L0 * std::pow(E * strain / s0, m));
    };
    const double at   = s0 / E * std::pow(L0 / L / m, 1 / m);
    const double mean = n_fibers * E * area * at * holds(at);
    const double deviation =
      E * area * at * std::sqrt(n_fibers * holds(at) * (1 - holds(at)));

    double error = 0, away = 0, largest = 0;
    for (const auto &[strain, force] : pull(parameters, checks))
      {
        error   = std::max(error,
                         std::abs(force - exact_force(strains, strain)) / mean);
        away    = std::max(away,
                        std::abs(force / (n_fibers * E * area * strain) -
                                 holds(strain)));
        largest = std::max(largest, force);
      }
    checks.below("force by the strengths drawn, over Daniels' largest",
                 error,
                 .001);
    checks.below("share that holds by Daniels (Kolmogorov, 5 %)",
                 away * std::sqrt(n_fibers),
                 1.36);
    checks.below("largest force in deviations of Daniels'",
                 (largest - mean) / deviation,
                 3);
  }
} // namespace



int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::ofstream                            output("output");
  Checks                                   checks(output);
  check_element(checks);
  check_strengths(checks);
  check_bundle(checks);
}
