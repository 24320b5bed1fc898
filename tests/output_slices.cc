// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// A plane across straight fibers cuts each once, in its section; one along a
// fiber's axis cuts out its length times its width. The sections of the tow
// have the width, height and packing of its layers.

#include <fiberloom/output/slices.h>
#include <fiberloom/output/tow_sections.h>

#include <cmath>
#include <fstream>

using namespace fiberloom;

namespace
{
  constexpr double radius = .01, length = 1;

  Fiber
  straight_fiber(const double y, const double z)
  {
    Fiber fiber{0, radius, 73000, .22, {}, {}, {}};
    for (unsigned int n = 0; n < 9; ++n)
      {
        fiber.centers.emplace_back(length * (n / 8. - .5), y, z);
        fiber.directions_1.push_back(Vector3::UnitY());
        fiber.directions_2.push_back(Vector3::UnitZ());
      }
    return fiber;
  }

  /** Two fibers below, three above them, all touching. */
  FiberSet
  small_tow()
  {
    FiberSet fibers;
    Tow      tow{Tow::Family::warp, 0, 0, 3 * radius, 2 * radius, {}};
    for (unsigned int i = 0; i < 5; ++i)
      {
        const bool upper = i > 1;
        fibers.fibers.push_back(
          straight_fiber(upper ? 2 * radius * (i - 3.) : 2 * radius * (i - .5),
                         upper ? std::sqrt(3.) * radius : 0));
        tow.fibers.push_back(i);
      }
    fibers.tows.push_back(tow);
    return fibers;
  }
} // namespace

int
main()
{
  std::ofstream   out("output");
  const FiberSet  fibers = small_tow();
  const FiberMesh mesh(fibers);
  const DofVector q = mesh.reference();

  const double polygon_share =
    32 / (2 * M_PI) * std::sin(2 * M_PI / 32); // 32 corners for a circle
  const double circle = M_PI * radius * radius * polygon_share;

  // across, also through nodes and slanted
  for (const double x : {0., .125, .33})
    for (const double slant : {0., .6})
      {
        const Vector3 along(std::sin(slant), std::cos(slant), 0);
        const auto    outlines =
          cut_fibers(mesh,
                     q,
                     {"", "", Vector3(x, 0, 0), along, Vector3::UnitZ()});
        double area = 0;
        for (const auto &outline : outlines)
          area += enclosed_area(outline);
        out << outlines.size() << " " << area * std::cos(slant) / (5 * circle)
            << "\n";
      }

  // along, off the axis of the middle fiber by half a radius
  const auto lengthwise = cut_fibers(
    mesh,
    q,
    {"", "", Vector3(0, radius / 2, 0), Vector3::UnitX(), Vector3::UnitZ()});
  for (const auto &outline : lengthwise)
    out << "fiber " << outline.fiber << " "
        << (std::abs(
              enclosed_area(outline) / (std::sqrt(3.) * radius * length) - 1) <
            .01)
        << "\n";

  for (const auto &plane : slice_planes(fibers, mesh, q, Slices::both))
    out << plane.name << ", " << plane.title << ", " << plane.along.transpose()
        << "\n";

  const auto sections = tow_sections(fibers, mesh, q, 0);
  const auto middle   = sections[4];
  // area and length of the hull of the centres, widened by the radius
  const double hull = (3 * std::sqrt(3.) + 10 + M_PI) * radius * radius;
  out << sections.size() << " " << middle.width / (6 * radius) << " "
      << middle.height / ((2 + std::sqrt(3.)) * radius) << " "
      << middle.abscissa / (length / 2) << " "
      << middle.centroid[2] / (std::sqrt(3.) * radius) << "\n"
      << "area " << (std::abs(middle.area / hull - 1) < 1e-3)
      << " packing times area "
      << middle.packing * middle.area / (5 * M_PI * radius * radius) << "\n";
}
