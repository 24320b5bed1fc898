// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>

#include <fiberloom/fabric/arrangement.h>

#include <cmath>

namespace fiberloom
{
  std::vector<std::array<double, 2>>
  hexagon(const unsigned int n_fibers)
  {
    unsigned int n_rings = 0, n_whole = 1;
    while (n_whole < n_fibers)
      n_whole += 6 * ++n_rings;
    if (n_whole != n_fibers)
      throw InputError(std::to_string(n_fibers) +
                       " fibers are no whole hexagon; allowed: " +
                       std::to_string(n_whole - 6 * n_rings) + " or " +
                       std::to_string(n_whole));

    std::vector<std::array<double, 2>> centers = {{{0., 0.}}};
    for (unsigned int ring = 1; ring <= n_rings; ++ring)
      for (unsigned int side = 0; side < 6; ++side)
        for (unsigned int k = 0; k < ring; ++k)
          {
            const double corner = side * M_PI / 3,
                         along  = corner + 2 * M_PI / 3;
            centers.push_back(
              {{ring * std::cos(corner) + k * std::cos(along),
                ring * std::sin(corner) + k * std::sin(along)}});
          }
    return centers;
  }



  Curve
  helix(const double length,
        const double radius,
        const double turns,
        const double start_angle)
  {
    const double rate = 2 * M_PI * turns; // by s
    return {[=](const double s) {
              const double angle = start_angle + rate * s;
              return Vector3(length * (s - .5),
                             radius * std::cos(angle),
                             radius * std::sin(angle));
            },
            [=](const double s) {
              const double angle = start_angle + rate * s;
              return Vector3(length,
                             -rate * radius * std::sin(angle),
                             rate * radius * std::cos(angle));
            },
            1};
  }
} // namespace fiberloom
