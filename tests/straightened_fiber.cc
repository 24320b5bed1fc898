// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// A fiber that is straight without stress starts as the arc that it is given
// as, with the energy of that bending and no other; unbent by its ends, it has
// the energy and exerts the moment of the bending that is left.

#include <fiberloom/fabric/fabric_parameters.h>

#include <fiberloom/simulation/stage_run.h>

#include <deal.II/base/mpi.h>

#include <fstream>

#include "checks.h"

using namespace fiberloom;

namespace
{
  constexpr double bend = 10, radius = .05, E = 1000; // curvature 1 / bend

  Parameters
  scene(const unsigned int n_elements, const std::string &more)
  {
    std::ofstream("arc.prm")
      << "set Stages = load\nset Drives = clamp, tip\n"
         "subsection Drive clamp\nset Ends = 0 start\nend\n"
         // arcs of the length 10 and the angle 1 - 0.9 t
         "subsection Drive tip\nset Ends = 0 end\n"
         "set Translation = 10*(sin(1-0.9*t)/(1-0.9*t) - sin(1)); "
         "10*((1-cos(1-0.9*t))/(1-0.9*t) - 1 + cos(1)); 0\n"
         "set Rotation = 0; 0; -0.9*t\nend\n"
         "subsection Load\nset Largest step = 0.25\nend\n"
         "subsection Fibers\n"
         "set Curves = 10*sin(s); 10 - 10*cos(s); 0\nset Radius = 0.05\n"
         "set Young modulus = 1000\nset Poisson ratio = 0\n"
         "set Elements per fiber = "
      << n_elements << "\n"
      << more << "end\n";
    Parameters parameters = Parameters::parse("arc.prm", {});
    resolve_fabric(parameters);
    return parameters;
  }

  double
  energy(const FiberMesh &mesh, const DofVector &q)
  {
    double energy = 0;
    for (unsigned int e = 0; e < mesh.n_elements(); ++e)
      energy += mesh.element(e).energy(mesh.element_dofs(q, e));
    return energy;
  }

  const std::string straight = "set Stress free = straight\n";

  /** Against 1/2 E I k^2 L with what a Saint Venant-Kirchhoff bar adds. */
  double
  energy_error(const unsigned int n_elements)
  {
    const FiberMesh mesh(build_fiber_set(scene(n_elements, straight)));
    const double    I = M_PI * std::pow(radius, 4) / 4, k = 1 / bend;
    // axis of unchanged length: E A <z^4> k^4 / 8 on top
    const double exact =
      bend * (.5 * E * I * k * k +
              E * M_PI * std::pow(radius, 6) / 64 * std::pow(k, 4));
    return energy(mesh, mesh.initial()) / exact - 1;
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::ofstream                            output("output");
  Checks                                   checks(output);

  const double coarse = energy_error(4), fine = energy_error(8);
  checks.below("energy of bending, 4 elements", coarse, 3e-3);
  checks.below("energy of bending, 8 elements", fine, 1e-3);
  checks.above("order of convergence", std::log2(std::abs(coarse / fine)), 1.9);

  const FiberMesh given(build_fiber_set(scene(8, "")));
  checks.below("energy where the arc is stress-free",
               energy(given, given.initial()),
               1e-12);

  const Parameters parameters = scene(8, straight);
  const FiberSet   fibers     = build_fiber_set(parameters);
  const FiberMesh  mesh(fibers);
  checks.below("starts as the arc",
               (mesh.initial() - given.initial()).norm(),
               1e-12);
  ContactGenerator generator(fibers, mesh, parameters.contact, MPI_COMM_WORLD);
  StageStatistics  statistics;
  statistics.name = "load";
  Log   log(MPI_COMM_WORLD);
  State state;
  state.q = mesh.initial();
  const Scene  whole{parameters, fibers, mesh};
  const auto   stage = create_stage("load", whole);
  StageRun     run(whole,
               *stage,
               {generator, log, MPI_COMM_WORLD, [] { return false; }},
               statistics,
               state);
  const double moment       = E * M_PI * std::pow(radius, 4) / 4 / bend;
  double       wrong_moment = 0, wrong_energy = 0;
  run.run(state, [&](const IncrementReport &report) {
    if (report.state.increment == 0)
      return; // nodes on the arc are not yet in balance
    const double angle = 1 - .9 * report.state.load;
    wrong_moment =
      std::max(wrong_moment,
               std::abs(std::abs(report.reactions[0][5]) / moment - angle));
    wrong_energy = std::max(wrong_energy,
                            std::abs(energy(mesh, report.state.q) /
                                       energy(mesh, mesh.initial()) -
                                     angle * angle));
  });
  checks.below("moment at the clamp over that at the start",
               wrong_moment,
               1e-3);
  checks.below("energy over that at the start", wrong_energy, 1e-3);
}
