// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/fabric/tow_family.h>

#include <fiberloom/output/paths.h>

#include <iomanip>
#include <sstream>

namespace fiberloom
{
  std::string
  paths_csv(const FiberSet &fibers, const FiberMesh &mesh, const DofVector &q)
  {
    std::ostringstream out;
    out << "# Axes of fibers, to be read by Fibers/File\n"
        << "fiber,tow,family,x[mm],y[mm],z[mm],radius[mm],"
           "young_modulus[MPa],poisson_ratio\n"
        << std::setprecision(15);
    for (unsigned int f = 0; f < fibers.fibers.size(); ++f)
      {
        const Fiber &fiber = fibers.fibers[f];
        const auto  &line  = mesh.lines()[f];
        for (unsigned int n = 0; n < line.n_nodes(); ++n)
          {
            const auto x = q.segment<3>(9 * (line.first_node + n));
            out << f << "," << fiber.tow << ","
                << family_name(fibers.tows[fiber.tow].family);
            for (unsigned int d = 0; d < 3; ++d)
              out << "," << x[d];
            out << "," << fiber.radius << "," << fiber.young_modulus << ","
                << fiber.poisson_ratio << "\n";
          }
      }
    return out.str();
  }
} // namespace fiberloom
