// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// A plain weave of single fibers that are sine waves has the crimp, weight,
// thickness, slope and curvature of closed forms, also turned and sheared in
// its plane; a bent one is not measured.

#include <fiberloom/output/fabric_measures.h>

#include <cmath>
#include <fstream>
#include <map>

#include "checks.h"
#include "sample_fibers.h"

using namespace fiberloom;

namespace
{
  constexpr unsigned int n_tows = 4;
  constexpr double       pitch = 12, amplitude = 1.5, density = 2e-9;

  FiberSet
  sine_weave(const double given_density)
  {
    FiberSet set;
    for (const auto family : {Tow::Family::warp, Tow::Family::fill})
      for (unsigned int t = 0; t < n_tows; ++t)
        {
          const bool   is_warp = family == Tow::Family::warp;
          const double center  = (t - .5 * (n_tows - 1)) * pitch;
          const double sign    = (t % 2 == 0) == is_warp ? 1 : -1;
          const auto   line    = [&](const double s) {
            const double along = (s - .5) * n_tows * pitch;
            // At the crossings, half a pitch from the ends, are the crests.
            const double height =
              sign * amplitude * std::sin(M_PI * (along / pitch + .5 * n_tows));
            return is_warp ? Vector3(along, center, height) :
                                  Vector3(center, along, height);
          };
          const unsigned int number = set.fibers.size();
          Fiber              fiber =
            curved_fiber(line,
                         48,
                         is_warp ? Vector3::UnitY() : Vector3::UnitX());
          fiber.tow     = number;
          fiber.density = given_density;
          set.fibers.push_back(fiber);
          set.tows.push_back({family, t, center, 1, 1, {number}});
        }
    return set;
  }

  /** Length of a half wave over its projection, less 1. */
  double
  crimp_of_sine()
  {
    const double slope = M_PI * amplitude / pitch, k = std::hypot(1, slope);
    return 2 / M_PI * k * std::comp_ellint_2(slope / k) - 1;
  }

  DofVector
  mapped(const DofVector &q, const std::function<Vector3(const Vector3 &)> &map)
  {
    DofVector moved = q;
    for (Eigen::Index i = 0; i < q.size(); i += 3)
      moved.segment<3>(i) = map(q.segment<3>(i));
    return moved;
  }

  std::map<std::string, double>
  measure(const FiberSet &set, const DofVector &q)
  {
    const FiberMesh mesh(set);
    const auto      part = part_between_crossings(set, mesh, q);
    if (!part)
      return {};
    std::map<std::string, double> measures;
    for (const auto &[column, value] : fabric_measures(set, mesh, q, *part))
      measures[column.heading()] = value;
    return measures;
  }

  void
  check(Checks                       &checks,
        const std::string            &name,
        std::map<std::string, double> measures,
        const double                  area_ratio)
  {
    const double area      = 9 * pitch * pitch * area_ratio;
    const double length    = 2 * 9 * pitch * (1 + crimp_of_sine());
    const double thickness = 2 * (amplitude + 1);
    for (const auto &[key, expected] : std::map<std::string, double>{
           {"crimp_warp", crimp_of_sine()},
           {"crimp_fill", crimp_of_sine()},
           {"thickness[mm]", thickness},
           {"measured_area[mm2]", area},
           {"areal_weight[kg/m2]", 1e9 * density * M_PI * length / area},
           {"fiber_volume_fraction", M_PI * length / (area * thickness)},
           {"fiber_volume_fraction_of_tows", 1},
           {"tow_width_warp[mm]", 2},
           {"tow_height_fill[mm]", 2},
           {"undulation_angle_warp[rad]", std::atan(M_PI * amplitude / pitch)},
           {"largest_curvature_fill[1/mm]",
            M_PI * M_PI * amplitude / pitch / pitch},
           {"largest_bending_strain_fill",
            M_PI * M_PI * amplitude / pitch / pitch}})
      checks.below(name + ": error of " + key,
                   measures[key] / expected - 1,
                   .01);
    checks.below(name + ": error of the crimp over itself",
                 measures["crimp_warp"] / crimp_of_sine() - 1,
                 1e-3);
    checks.below(name + ": spread of the crimp",
                 measures["crimp_spread_warp"],
                 1e-6);
  }
} // namespace

int
main()
{
  std::ofstream   output("output");
  Checks          checks(output);
  const FiberSet  set = sine_weave(density);
  const DofVector q   = FiberMesh(set).reference();

  check(checks, "flat", measure(set, q), 1);
  const Eigen::AngleAxisd turn(.5, Vector3::UnitZ());
  check(checks,
        "turned",
        measure(set, mapped(q, [&](const Vector3 &x) { return turn * x; })),
        1);

  // As a frame of bars: nothing is stretched along the tows.
  const double shear = .3;
  Matrix3      tilt  = Matrix3::Identity();
  tilt.col(1)        = Vector3(std::sin(shear), std::cos(shear), 0);
  auto sheared =
    measure(set, mapped(q, [&](const Vector3 &x) { return tilt * x; }));
  checks.below("sheared: error of the area",
               sheared["measured_area[mm2]"] /
                   (9 * pitch * pitch * std::cos(shear)) -
                 1,
               1e-3);
  checks.below("sheared: error of the crimp",
               sheared["crimp_fill"] / crimp_of_sine() - 1,
               1e-2);

  // Positions only: around a cylinder.
  DofVector bent = q;
  for (Eigen::Index i = 0; i < q.size(); i += 9)
    {
      const double angle = q[i] / 20;
      bent[i]            = (20 - q[i + 2]) * std::sin(angle);
      bent[i + 2]        = 20 - (20 - q[i + 2]) * std::cos(angle);
    }
  checks.that("bent: not measured", measure(set, bent).empty());
  const auto light = measure(sine_weave(0), q);
  checks.that("without density: no weight, all else is there",
              light.count("areal_weight[kg/m2]") == 0 && light.size() == 22);
}
