// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// Straight fibers between plates: force and friction of the plates, overlap and
// packing of regular stacks under a pressure, against closed forms.

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
  constexpr double radius = .008, stiff = 7.3e5; // so that contact gives way
  constexpr double plate_stiffness = M_PI_4 * stiff;
  constexpr double period          = 2 * radius; // both ways: side by side

  void
  add_fiber(FiberSet &set, const Tow::Family family, const Vector3 &middle)
  {
    const bool    is_warp     = family == Tow::Family::warp;
    const Vector3 along       = is_warp ? Vector3::UnitX() : Vector3::UnitY(),
                  up          = Vector3::UnitZ();
    const unsigned int number = set.fibers.size();

    Tow tow;
    tow.family     = family;
    tow.number     = number;
    tow.center     = middle[is_warp ? 1 : 0];
    tow.half_width = tow.half_thickness = radius;
    tow.fibers                          = {number};
    set.tows.push_back(tow);
    Fiber fiber;
    fiber.tow           = number;
    fiber.radius        = radius;
    fiber.young_modulus = stiff;
    fiber.poisson_ratio = 0;
    for (const double place : {-.5, -.25, 0., .25, .5})
      fiber.centers.push_back(middle + place * period * along);
    fiber.directions_1.assign(5, up.cross(along));
    fiber.directions_2.assign(5, up);
    set.fibers.push_back(fiber);
  }



  /** Layers that cross each other. */
  FiberSet
  crossed(const unsigned int n)
  {
    FiberSet set;
    set.cell = std::array<double, 2>{{period, period}};
    for (unsigned int f = 0; f < n; ++f)
      add_fiber(set,
                f % 2 == 0 ? Tow::Family::warp : Tow::Family::fill,
                Vector3(0, 0, f * 2 * radius));
    return set;
  }



  /** Warp layers, every second one aside, under one of fill. */
  FiberSet
  parallel(const unsigned int n, const double aside)
  {
    const double height = std::sqrt(4 * radius * radius - aside * aside);
    FiberSet     set;
    set.cell = std::array<double, 2>{{period, period}};
    for (unsigned int f = 0; f < n; ++f)
      add_fiber(set, Tow::Family::warp, Vector3(0, f % 2 * aside, f * height));
    add_fiber(set,
              Tow::Family::fill,
              Vector3(0, 0, (n - 1) * height + 2 * radius));
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
      for (const auto &[column, value] : report.curve)
        last[column.heading()] = value;
    });
    return last;
  }



  /** A fiber in each plate, both moved along them. */
  void
  check_one(Checks &checks)
  {
    const Parameters parameters = settings({"Compact/Pressure=1"});
    const FiberSet   fibers     = crossed(2);
    const FiberMesh  mesh(fibers);
    const auto stage = create_stage("compact", Scene{parameters, fibers, mesh});
    const Supports supports = stage->supports(mesh.reference());
    System         system(mesh, supports, MPI_COMM_WORLD);
    State          state;
    state.q = mesh.reference();
    stage->begin(state);
    const double depth = .01 * radius, start = .02 / 4 * radius;
    state.placements.back().position[0] = 4 * radius - 2 * depth;

    std::vector<ContactElement> contacts;
    Targets                     targets;
    for (const Placement &placement : state.placements)
      targets.bodies.push_back({placement});
    system.reinit(contacts);
    system.plates().update(state, state.q, {});
    system.assemble_residual(state, targets, contacts);
    const double force = plate_stiffness * (depth - start / 2) * period;
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
                 system.plates().dissipation(state) /
                     (2 * .5 * force * (slip - elastic)) -
                   1,
                 1e-9);
    const auto history = system.plates().history(state);
    checks.below("slip to be regained",
                 history.at(0).slip[1] / elastic - 1,
                 1e-9);
    system.plates().update(state, state.q, history);
    checks.below("no loss by what has slipped before",
                 system.plates().dissipation(state) / force,
                 1e-9);
  }



  /** Where fibers cross they overlap by what a line penalty has as force. */
  void
  check_crossed(Checks &checks)
  {
    const double       pressure = 10, stiffness = 1000;
    const unsigned int n = 4;
    const auto         last =
      pressed(crossed(n),
              settings({"Compact/Pressure=10", "Contact/Line stiffness=1000"}));
    const double force = pressure * period * period;
    const double overlap =
      std::pow(1.5 * force / (stiffness * std::sqrt(4 * radius)), 2 / 3.);
    const double start = .02 / 4 * radius;
    const double in_plate =
      std::sqrt(2 * start * pressure * period / plate_stiffness);
    checks.below("in the plates, over where the law is linear",
                 in_plate / start,
                 1);
    const double height = n * 2 * radius - (n - 1) * overlap - 2 * in_plate;
    checks.below("overlap of crossed layers under pressure",
                 (last.at("thickness[mm]") - height) / ((n - 1) * overlap),
                 3e-3);
  }



  /** Of two layers that @p high has more than @p low , under next to no
   * pressure. */
  double
  packing(const FiberSet &low, const FiberSet &high)
  {
    const Parameters parameters = settings({"Compact/Pressure=1"});
    const double     height = pressed(high, parameters).at("thickness[mm]") -
                          pressed(low, parameters).at("thickness[mm]");
    return 2 * M_PI * radius * radius / (period * height);
  }
} // namespace



int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::ofstream                            output("output");
  Checks                                   checks(output);
  check_one(checks);
  check_crossed(checks);
  checks.below("square packing",
               packing(crossed(2), crossed(4)) / M_PI_4 - 1,
               1e-3);
  checks.below("hexagonal packing",
               packing(parallel(2, radius), parallel(4, radius)) /
                   (M_PI / std::sqrt(12)) -
                 1,
               1e-3);
}
