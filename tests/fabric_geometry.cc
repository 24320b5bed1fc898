// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// The flat fabric of the paper has the totals of its table 1; its fibers lie
// where they should, with right-handed sections, and apart within a family.
// Fibers along polylines: nodes, length, sections that do not twist.

#include <fiberloom/base/parameters.h>

#include <fiberloom/fabric/fabric_parameters.h>
#include <fiberloom/fabric/fiber_set.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <fstream>

using namespace fiberloom;

Parameters
read(const std::string &file)
{
  Parameters parameters = Parameters::parse(file, {});
  resolve_fabric(parameters);
  return parameters;
}

/** Largest deviation of the sections from right-handed orthonormal frames. */
double
frame_error(const FiberSet &set)
{
  double error = 0;
  for (const Fiber &fiber : set.fibers)
    for (std::size_t n = 0; n + 1 < fiber.centers.size(); ++n)
      {
        const Vector3 chord =
          (fiber.centers[n + 1] - fiber.centers[n]).normalized();
        const Vector3 normal =
          fiber.directions_1[n].cross(fiber.directions_2[n]);
        error = std::max({error,
                          (normal - chord).norm(),
                          std::abs(fiber.directions_1[n].norm() - 1),
                          std::abs(fiber.directions_2[n].norm() - 1)});
      }
  return error;
}

/** Least distance of two straight axes of a family, over the radius. */
double
least_distance(const FiberSet &set, const Tow::Family family)
{
  double least = 1e9;
  for (std::size_t i = 0; i < set.fibers.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (set.tows[set.fibers[i].tow].family == family &&
          set.tows[set.fibers[j].tow].family == family)
        least = std::min(
          least,
          (set.fibers[i].centers[0] - set.fibers[j].centers[0]).norm() /
            set.fibers[i].radius);
  return least;
}

/** How far surfaces reach beyond the half width and thickness of their tow. */
double
reach_beyond_tow(const FiberSet &set)
{
  double beyond = -1e9;
  for (const Tow &tow : set.tows)
    for (const unsigned int f : tow.fibers)
      {
        const Fiber  &fiber  = set.fibers[f];
        const Vector3 center = fiber.centers[0];
        const double  across =
          center[tow.family == Tow::Family::warp ? 1 : 0] - tow.center;
        beyond =
          std::max({beyond,
                    std::abs(across) + fiber.radius - tow.half_width,
                    std::abs(center[2]) + fiber.radius - tow.half_thickness});
      }
  return beyond;
}

void
check_paper(std::ostream &output)
{
  for (const std::string scene : {"plain_weave", "twill_weave"})
    {
      const FiberSet set =
        build_fiber_set(read(SOURCE_DIR "/../prm/paper/" + scene + ".prm"));
      std::size_t n_nodes = 0;
      for (const Fiber &fiber : set.fibers)
        n_nodes += fiber.centers.size();
      output << scene << ": " << set.fibers.size() << " fibers, " << n_nodes
             << " nodes, " << 9 * n_nodes << " dofs, " << set.tows.size()
             << " tows" << std::endl;
      output << "frames right: " << (frame_error(set) < 1e-12)
             << ", distances over r " << least_distance(set, Tow::Family::warp)
             << ' ' << least_distance(set, Tow::Family::fill)
             << ", tow bounds are tight: "
             << (std::abs(reach_beyond_tow(set)) < 1e-12) << std::endl;

      const Fiber &warp = set.fibers.front(), &fill = set.fibers.back();
      output << "warp from " << warp.centers.front()[0] << " to "
             << warp.centers.back()[0] << ", fill from "
             << fill.centers.front()[1] << " to " << fill.centers.back()[1]
             << std::endl;
      output << "first directions " << warp.directions_1[0].transpose() << ", "
             << fill.directions_1[0].transpose() << std::endl;
    }
}

void
check_polylines(std::ostream &output)
{
  std::ofstream prm("fibers.prm");
  prm << "set Stages = load\nset Drives = d\n"
         "subsection Drive d\nset Ends = 0 start\nend\n"
         "subsection Fibers\nset Radius = 0.01\nset Elements per fiber = 50\n"
         "set Polylines = 0 0 0, 0 3 0, 4 3 0; ";
  // a helix of one turn, radius 1, rising by 2
  for (unsigned int i = 0; i <= 400; ++i)
    {
      const double angle = 2 * M_PI * i / 400;
      prm << (i > 0 ? ", " : "") << std::cos(angle) << ' ' << std::sin(angle)
          << ' ' << angle / M_PI;
    }
  prm << "\nend\n";
  prm.close();

  const FiberSet set  = build_fiber_set(read("fibers.prm"));
  const Fiber   &bent = set.fibers[0], &helix = set.fibers[1];
  output << "polylines: " << set.fibers.size() << " fibers, "
         << bent.centers.size() << " nodes, at a third of the first "
         << bent.centers[33].transpose() << std::endl;

  // the sections of a curve that closes in direction have turned about it by
  // 2 pi times the sine of the slope, if they do not twist
  const Vector3 &start = helix.directions_1.front(),
                &end   = helix.directions_1.back();
  const double rise    = 1 / std::sqrt(1 + M_PI * M_PI);
  output << "helix: turned by an angle of cosine "
         << std::round(100 * start.dot(end)) / 100 << ", expected "
         << std::round(100 * std::cos(2 * M_PI * rise)) / 100
         << ", sections across the axis: "
         << (frame_error({{helix}, {}, {}}) < .05) << std::endl;
}

int
main()
{
  std::ofstream output("output");
  check_paper(output);
  check_polylines(output);
}
