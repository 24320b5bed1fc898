// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// Straight fibers between plates: force and friction of one of them, and the
// height of regular stacks under a pressure, against closed forms.

#include <fiberloom/base/parameters.h>

#include <fiberloom/fabric/fabric_parameters.h>

#include <fiberloom/stages/cell.h>

#include <deal.II/base/mpi.h>

#include <fstream>
#include <map>

#include "checks.h"
#include "run_stages.h"

using namespace fiberloom;

namespace
{
  constexpr double radius = .008, young_modulus = 73000, length = .1;
  constexpr double plate_stiffness = M_PI_4 * young_modulus;
  constexpr double width           = 2 * radius; // of the cell

  /** Fibers along x without contraction above each other, every second one
   * aside, as far apart as they touch. */
  FiberSet
  stack(const unsigned int n, const double aside)
  {
    FiberSet set;
    set.cell            = std::array<double, 2>{{length, width}};
    const double height = std::sqrt(4 * radius * radius - aside * aside);
    for (unsigned int f = 0; f < n; ++f)
      {
        Tow tow;
        tow.family     = Tow::Family::warp;
        tow.number     = f;
        tow.center     = f % 2 * aside;
        tow.half_width = tow.half_thickness = radius;
        tow.fibers                          = {f};
        set.tows.push_back(tow);
        Fiber fiber;
        fiber.tow           = f;
        fiber.radius        = radius;
        fiber.young_modulus = young_modulus;
        fiber.poisson_ratio = 0;
        for (unsigned int k = 0; k < 5; ++k)
          fiber.centers.emplace_back(length * (.25 * k - .5),
                                     tow.center,
                                     f * height);
        fiber.directions_1.assign(5, Vector3::UnitY());
        fiber.directions_2.assign(5, Vector3::UnitZ());
        set.fibers.push_back(fiber);
      }
    return set;
  }



  Parameters
  settings(const std::vector<std::string> &more)
  {
    std::vector<std::string> all = {"Stages=compact",
                                    "Contact/Friction coefficient=.5",
                                    "Contact/Largest penetration=.02",
                                    "Solver/Contact tolerance=1e-7",
                                    "Compact/First step=.25",
                                    "Compact/Largest step=.5"};
    all.insert(all.end(), more.begin(), more.end());
    Parameters parameters =
      Parameters::parse(SOURCE_DIR "/scenes/small_cell.prm", all);
    resolve_fabric(parameters);
    return parameters;
  }



  std::map<std::string, double>
  pressed(const FiberSet &fibers, const Parameters &parameters)
  {
    std::map<std::string, double> last;
    run_stages(parameters, fibers, [&](const IncrementReport &report) {
      for (const auto &[name, value] : report.curve)
        last[name] = value;
    });
    return last;
  }



  /** A fiber in both plates at once, then moved along them. */
  void
  check_one(Checks &checks)
  {
    const Parameters parameters = settings({"Compact/Pressure=1"});
    const FiberSet   fibers     = stack(1, 0);
    const FiberMesh  mesh(fibers);
    const auto stage = create_stage("compact", Scene{parameters, fibers, mesh});
    const Supports supports = stage->supports(mesh.reference());
    System         system(mesh, supports, MPI_COMM_WORLD);
    State          state;
    state.q = mesh.reference();
    stage->begin(state);
    const double depth = .01 * radius, start = .02 / 4 * radius;
    state.placements.back().position = {2 * (radius - depth), 0, 0};

    std::vector<ContactElement> contacts;
    Targets                     targets;
    for (const Placement &placement : state.placements)
      targets.bodies.push_back({placement});
    system.reinit(contacts);
    system.update_plates(state, state.q, {});
    system.assemble_residual(state, targets, contacts);
    const double force = plate_stiffness * (depth - start / 2) * length;
    checks.below("force of the plates",
                 -system.reactions().back()[0] / force - 1,
                 1e-12);

    // All limits are reached, with one elastic slip to be regained.
    const double slip = .5 * radius, elastic = .05 * radius;
    const double energy = system.energy(state, contacts);
    for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
      state.q[9 * n + 1] += slip;
    checks.below("work of friction",
                 (system.energy(state, contacts) - energy) /
                     (2 * .5 * force * (slip - elastic / 3)) -
                   1,
                 1e-9);
    checks.below("what of it is lost",
                 system.plate_dissipation(state) /
                     (2 * .5 * force * (slip - elastic)) -
                   1,
                 1e-9);
    const auto history = system.plate_history(state);
    checks.below("slip to be regained",
                 history.at(0).slip[1] / elastic - 1,
                 1e-9);
    system.update_plates(state, state.q, history);
    checks.below("no loss by what has slipped before",
                 system.plate_dissipation(state) / force,
                 1e-9);
  }



  /** Fibers straight above each other, whose sections get lower as well. */
  void
  check_column(Checks &checks)
  {
    const double       pressure = 1000, force = pressure * width; // per length
    const double       between = 60000;
    const unsigned int n       = 4;
    const auto         last =
      pressed(stack(n, 0),
              settings({"Compact/Pressure=1000",
                        "Contact/Line stiffness=" + std::to_string(between)}));

    // Of the law of Saint Venant and Kirchhoff: 2 r F = A P.
    double stretch = 1;
    for (unsigned int i = 0; i < 50; ++i)
      stretch =
        std::cbrt(stretch - 4 * force / (M_PI * radius * young_modulus));
    const double start  = .02 / 4 * radius;
    const double height = n * 2 * radius * stretch - (n - 1) * force / between -
                          2 * (force / plate_stiffness + start / 2);
    checks.below("height of a column under pressure",
                 last.at("thickness[mm]") / height - 1,
                 1e-6);
  }



  /** Of the layers that a higher stack has more under next to no pressure. */
  double
  packing(const double aside)
  {
    const Parameters      parameters = settings({"Compact/Pressure=.1"});
    std::array<double, 2> heights;
    for (unsigned int i = 0; i < 2; ++i)
      heights[i] =
        pressed(stack(2 + 2 * i, aside), parameters).at("thickness[mm]");
    return 2 * M_PI * radius * radius / (width * (heights[1] - heights[0]));
  }
} // namespace



int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::ofstream                            output("output");
  Checks                                   checks(output);
  check_one(checks);
  check_column(checks);
  checks.below("square packing", packing(0) / M_PI_4 - 1, 2e-3);
  checks.below("hexagonal packing",
               packing(radius) / (M_PI / std::sqrt(12)) - 1,
               2e-3);
}
