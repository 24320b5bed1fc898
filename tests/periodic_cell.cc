// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// A periodic cell: energy, residual and matrix belong together, elongations of
// the cell and plates included; where the cell is cut and how many periods it
// has does not matter; its tangent stiffness is what small strains find.

#include <fiberloom/base/parameters.h>

#include <fiberloom/fabric/fabric_parameters.h>

#include <fiberloom/stages/cell.h>

#include <deal.II/base/mpi.h>

#include <Epetra_Vector.h>

#include <fstream>
#include <map>

#include "checks.h"
#include "run_stages.h"
#include "sample_model.h"

using namespace fiberloom;

namespace
{
  struct Ended
  {
    Parameters                    parameters;
    FiberSet                      fibers;
    std::map<std::string, double> last;       // of all columns
    double                        energy = 0; // [N mm]
    std::vector<double>           stiffness;
    State                         state;
    std::vector<ContactElement>   contacts;
    Supports                      supports;
  };

  Ended
  run_cell(const std::vector<std::string> &settings)
  {
    Ended ended;
    ended.parameters =
      Parameters::parse(SOURCE_DIR "/scenes/small_cell.prm", settings);
    resolve_fabric(ended.parameters);
    ended.fibers = build_fiber_set(ended.parameters);
    run_stages(ended.parameters,
               ended.fibers,
               [&](const IncrementReport &report) {
                 for (const auto &[name, value] : report.curve)
                   ended.last[name] = value;
                 ended.energy    = report.statistics.elastic_energy;
                 ended.stiffness = report.statistics.membrane_stiffness;
                 ended.state     = report.state;
                 ended.contacts  = report.contacts;
                 ended.supports  = report.supports;
               });
    return ended;
  }



  /** Slopes of energy and residual along all unknowns at once, in some
   * direction, with the cell free. */
  void
  check_derivatives(Checks &checks, const std::string &name, Ended ended)
  {
    for (unsigned int k = 0; k < 3; ++k)
      ended.supports.bodies[Cell::body].prescribed.reset(k);
    const FiberMesh mesh(ended.fibers);
    System          system(mesh, ended.supports, MPI_COMM_WORLD);
    for (ContactElement &contact : ended.contacts)
      contact.slip_before = contact.slip;
    system.reinit(ended.contacts);
    const unsigned int n = system.layout().n_dofs();

    std::srand(7);
    Eigen::VectorXd direction = Eigen::VectorXd::Random(n);
    for (unsigned int i = 0; i < n; ++i)
      if (system.motion().is_fixed(i))
        direction[i] = 0;
    const double step  = 1e-7;
    const auto   moved = [&](const double factor) {
      State state = ended.state;
      system.motion().advance(state, direction, factor);
      return state;
    };
    const auto residual = [&](const State &state) {
      auto    contacts = ended.contacts;
      Targets targets;
      for (const Placement &placement : state.placements)
        targets.bodies.push_back({placement});
      system.assemble(state, targets, contacts);
      return Eigen::VectorXd(
        -Eigen::Map<const Eigen::VectorXd>(system.right_hand_side().data(), n));
    };
    const State start            = moved(1e-4); // out of balance
    ended.state                  = start;
    const Eigen::VectorXd forces = residual(start);
    const Eigen::VectorXd slope  = multiply(system, direction);
    const double          rise   = (system.energy(moved(step), ended.contacts) -
                         system.energy(moved(-step), ended.contacts)) /
                        (2 * step);
    checks.below(name + ", slope of the energy",
                 rise / forces.dot(direction) - 1,
                 1e-5);
    checks.below(name + ", slope of the residual",
                 relative_error((residual(moved(step)) -
                                 residual(moved(-step))) /
                                  (2 * step),
                                slope),
                 1e-4);
  }



  void
  check_same(Checks            &checks,
             const std::string &name,
             const Ended       &one,
             const Ended       &other,
             const double       periods)
  {
    checks.below(name + ", energy",
                 other.energy / (periods * one.energy) - 1,
                 1e-6);
    for (const std::string column :
         {"thickness[mm]", "force_per_width_warp[N/mm]"})
      checks.below(name + ", " + column,
                   other.last.at(column) / one.last.at(column) - 1,
                   1e-6);
  }



  void
  check_stiffness(Checks &checks, const std::vector<std::string> &settings)
  {
    auto with = [&settings](std::vector<std::string> more) {
      more.insert(more.end(), settings.begin(), settings.end());
      return run_cell(more);
    };
    const auto C = with({"Stages=weave, relax, stiffness"}).stiffness;
    checks.below("symmetry of the stiffness",
                 std::max({std::abs(C[1] - C[3]),
                           std::abs(C[2] - C[6]),
                           std::abs(C[5] - C[7])}) /
                   C[0],
                 1e-7);
    checks.below("warp against fill", C[4] / C[0] - 1, 1e-4);
    checks.above("determinant of warp and fill", C[0] * C[4] - C[1] * C[3], 0);

    const double strain = 1e-7;
    const auto   pulled = with({"Stages=weave, relax, biaxial",
                                "Biaxial/Largest strain=1e-7",
                                "Biaxial/Strain ratio=0",
                                "Biaxial/First step=1",
                                "Biaxial/Largest step=1"}),
               held     = with({"Stages=weave, relax, biaxial",
                                "Biaxial/Largest strain=1e-9",
                                "Biaxial/First step=1",
                                "Biaxial/Largest step=1"});
    for (const auto &[column, k] :
         {std::make_pair("force_per_width_warp[N/mm]", 1),
          std::make_pair("force_per_width_fill[N/mm]", 4)})
      checks.below(std::string(column) + " of a small strain",
                   (pulled.last.at(column) - held.last.at(column)) /
                       (.99 * strain * C[k]) -
                     1,
                   .02);
  }
} // namespace



int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::ofstream                            output("output");
  Checks                                   checks(output);

  const std::vector<std::string> tight{"Solver/Contact tolerance=1e-9"};
  const auto                     with = [&tight](const std::string &setting) {
    auto settings = tight;
    settings.push_back(setting);
    return run_cell(settings);
  };
  const Ended cell = run_cell(tight);
  check_derivatives(checks, "pulled", cell);
  check_same(
    checks, "cut elsewhere", cell, with("Fabric/Cell cut=.25, .25"), 1);
  check_same(
    checks, "cut at a crossing", cell, with("Fabric/Cell cut=.5, 0"), 1);
  const Ended doubled = run_cell({tight[0],
                                  "Fabric/Warp/Tows=4",
                                  "Fabric/Fill/Tows=2",
                                  "Fabric/Warp/Elements per fiber=8",
                                  "Fabric/Fill/Elements per fiber=16"});
  check_same(checks, "two periods", cell, doubled, 2);

  const Ended pressed = run_cell({"Stages=weave, relax, compact",
                                  "Compact/Thickness=.055",
                                  "Compact/First step=.5",
                                  "Compact/Largest step=.5"});
  check_derivatives(checks, "pressed", pressed);
  checks.above("pressure [MPa]", pressed.last.at("pressure[MPa]"), 0);
  checks.equal("thickness", pressed.last.at("thickness[mm]"), .055);

  check_stiffness(checks, tight);
}
