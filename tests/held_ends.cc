// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// Two fibers one above the other, their ends held by bodies that let them tilt,
// are inclined in their plane: they come closer than two radii next to their
// ends, whatever the contact does. Where one body holds both, the penalty there
// gets about as stiff as the fibers' own sections and no stiffer, and the rest
// of the overlap is left. Where each end has a body of its own the overlap is
// held to what is asked for.

#include <fiberloom/fabric/fabric_parameters.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <fstream>

#include "checks.h"
#include "run_stages.h"

using namespace fiberloom;

namespace
{
  constexpr double young_modulus = 73000;

  struct Ended
  {
    double stiffness   = 0; // the largest, over Young's modulus
    double penetration = 0; // over the radius
  };

  Ended
  incline(const std::vector<std::string> &ends)
  {
    std::string drives, motions;
    for (unsigned int d = 0; d < ends.size(); ++d)
      {
        const std::string name  = "end" + std::to_string(d);
        const bool        moves = ends[d].find("end") != std::string::npos;
        drives += (d > 0 ? ", " : "") + name;
        motions += "subsection Drive " + name + "\nset Ends = " + ends[d] +
                   "\nset Hold = pinned\n" +
                   (moves ? "set Translation = -0.1*t; 0; 0.4*t\n" : "") +
                   "end\n";
      }
    std::ofstream("scene.prm")
      << "set Stages = load\nset Drives = " << drives
      << "\nsubsection Fibers\n"
         "set Polylines = 0 0 0, 1 0 0; 0 0 0.0206, 1 0 0.0206\n"
         "set Radius = 0.01\nset Young modulus = "
      << young_modulus
      << "\nset Poisson ratio = 0.22\nset Elements per fiber = 12\nend\n"
      << motions << "subsection Load\nset Largest step = 0.1\nend\n";
    Parameters parameters = Parameters::parse("scene.prm", {});
    resolve_fabric(parameters);

    Ended ended;
    run_stages(parameters,
               build_fiber_set(parameters),
               [&](const IncrementReport &report) {
                 ended.penetration =
                   report.statistics.largest_penetration_over_radius;
                 for (const ContactElement &contact : report.contacts)
                   ended.stiffness =
                     std::max(ended.stiffness,
                              contact.stiffness / young_modulus);
               });
    return ended;
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::ofstream                            output("output");
  Checks                                   checks(output);

  const Ended one          = incline({"0-1 start", "0-1 end"}),
              each         = incline({"0 start", "1 start", "0 end", "1 end"});
  constexpr double allowed = 1.3 * .02;
  checks.above("one body: stiffness over Young's modulus", one.stiffness, .785);
  checks.below("over that with a body each",
               one.stiffness / each.stiffness,
               .5);
  checks.above("one body: overlap that is left", one.penetration, allowed);
  checks.below("one body: overlap", one.penetration, .05);
  checks.below("a body each: overlap", each.penetration, allowed);
}
