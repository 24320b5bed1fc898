// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// A periodic cell: energy, residual and matrix belong together, elongations of
// the cell and plates included; where the cell is cut and how many periods it
// has does not matter; its tangent stiffness is symmetric and positive.

#include <fiberloom/base/parameters.h>

#include <fiberloom/fabric/fabric_parameters.h>

#include <fiberloom/stages/cell.h>

#include <deal.II/base/mpi.h>

#include <Eigen/Eigenvalues>

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
    double                        thickness = 0; // of a filled cell [mm]
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
                 for (const auto &[column, value] : report.curve)
                   ended.last[column.heading()] = value;
                 ended.energy    = report.statistics.elastic_energy;
                 ended.stiffness = report.statistics.membrane_stiffness;
                 ended.thickness = report.statistics.filled_thickness;
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
    const FiberMesh            mesh(ended.fibers);
    std::unique_ptr<Composite> composite;
    if (!ended.state.matrix.is_empty())
      composite = std::make_unique<Composite>(ended.state.matrix, mesh);
    System system(mesh, ended.supports, MPI_COMM_WORLD, composite.get());
    for (ContactElement &contact : ended.contacts)
      contact.slip_before = contact.slip;
    system.reinit(ended.contacts);
    system.plates().update(ended.state, ended.state.q, {});
    const unsigned int n = system.layout().n_dofs();

    std::srand(7);
    Eigen::VectorXd direction = Eigen::VectorXd::Random(n);
    for (unsigned int i = 0; i < n; ++i)
      if (system.motion().is_fixed(i))
        direction[i] = 0;
    const double step  = 3e-8;
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
                 1e-8);
    checks.below(name + ", slope of the residual",
                 relative_error((residual(moved(step)) -
                                 residual(moved(-step))) /
                                  (2 * step),
                                slope),
                 1e-7);
  }



  /** Energy [N mm] and mean forces [N] of a cell whose contacts are found; what
   * matrix it has is added before its period along the warp gets longer. */
  struct Found
  {
    double     energy;
    BodyVector forces;

    Found(const std::vector<std::string> &settings,
          const DofVector                &q,
          const Vector3                  &elongation,
          const double                    stretch = 0)
    {
      Parameters parameters =
        Parameters::parse(SOURCE_DIR "/scenes/small_cell.prm", settings);
      resolve_fabric(parameters);
      const FiberSet   fibers = build_fiber_set(parameters);
      const FiberMesh  mesh(fibers);
      ContactGenerator generator(fibers,
                                 mesh,
                                 parameters.contact,
                                 MPI_COMM_WORLD);
      State            state;
      state.q = q;
      state.placements.resize(1);
      state.placements[0].position = elongation;
      std::unique_ptr<Composite> composite;
      if (parameters.has_matrix())
        {
          add_matrix(parameters, mesh, state);
          composite = std::make_unique<Composite>(state.matrix, mesh);
        }
      Supports supports =
        Cell::supports({parameters, fibers, mesh, composite.get()}, 0);
      if (stretch > 0) // nodes that are held would go with the cell
        supports.attachments.clear();
      System system(mesh, supports, MPI_COMM_WORLD, composite.get());
      const BlockLayout &layout = system.layout();
      Eigen::VectorXd    longer = Eigen::VectorXd::Zero(layout.n_dofs());
      longer[layout.first_dof(layout.body_block(Cell::body))] = stretch;
      system.motion().advance(state, longer, 1);
      ContactRule rule;
      rule.points_follow = true;
      auto contacts = generator.generate(state.q, state.q, rule, state.contact);
      system.reinit(contacts);
      Targets targets({{state.placements[0]}});
      system.assemble_residual(state, targets, contacts);
      energy = system.energy(state, contacts);
      forces = system.reactions()[Cell::body];
    }
  };



  /** The same fabric in cells that are cut elsewhere or hold two periods. */
  void
  check_cells(Checks &checks, const Ended &cell)
  {
    const FiberMesh    mesh(cell.fibers);
    const FiberMesh   &seen       = mesh.with_images();
    const DofVector    q          = mesh.with_images(cell.state.q);
    const Vector3      elongation = cell.state.placements[Cell::body].position;
    const unsigned int n = mesh.lines()[0].n_nodes() - 1; // of a period
    // So many nodes of a fiber from one of them on, moved.
    const auto part = [&](const unsigned int fiber,
                          const unsigned int first,
                          const unsigned int n_nodes,
                          const Vector3     &by) {
      DofVector nodes =
        q.segment(9 * (seen.lines()[fiber].first_node + n + first),
                  9 * n_nodes);
      for (unsigned int k = 0; k < n_nodes; ++k)
        nodes.segment<3>(9 * k) += by;
      return nodes;
    };
    const auto join = [](const std::vector<DofVector> &parts) {
      std::vector<double> all;
      for (const DofVector &nodes : parts)
        all.insert(all.end(), nodes.data(), nodes.data() + nodes.size());
      return DofVector(Eigen::Map<DofVector>(all.data(), all.size()));
    };

    const Found whole({}, cell.state.q, elongation);
    checks.above("energy", whole.energy, 0);

    std::vector<DofVector> fibers;
    for (unsigned int f = 0; f < mesh.lines().size(); ++f)
      fibers.push_back(part(f, 2, n + 1, Vector3::Zero()));
    const Found cut({"Fabric/Cell cut=.25, .25"}, join(fibers), elongation);
    checks.below("cut elsewhere, energy", cut.energy / whole.energy - 1, 1e-9);
    checks.below("cut elsewhere, forces",
                 relative_error(cut.forces.head<2>(), whole.forces.head<2>()),
                 1e-6);

    fibers.clear();
    const Vector3 period(
      0, mesh.images() ? (*cell.fibers.cell)[1] + elongation[1] : 0, 0);
    for (unsigned int copy = 0; copy < 2; ++copy)
      for (unsigned int f = 0; f < mesh.lines().size() / 2; ++f)
        fibers.push_back(part(f, 0, n + 1, copy * period));
    for (unsigned int f = mesh.lines().size() / 2; f < mesh.lines().size(); ++f)
      fibers.push_back(part(f, 0, 2 * n + 1, Vector3::Zero()));
    const DofVector both = join(fibers);
    const Vector3   twice_as_long(elongation[0], 2 * elongation[1], 0);
    const std::vector<std::string> two_periods{
      "Fabric/Warp/Tows=4",
      "Fabric/Fill/Tows=2",
      "Fabric/Fill/Elements per fiber=16"};
    const Found twice(two_periods, both, twice_as_long);
    checks.below("two periods, energy", twice.energy / whole.energy - 2, 1e-9);
    // Not to the last digit: what holds each fiber once carries what the
    // tolerance leaves.
    checks.below("two periods, forces",
                 relative_error(Eigen::Vector2d(twice.forces[0] / 2,
                                                twice.forces[1]),
                                whole.forces.head<2>()),
                 1e-4);

    for (const std::string layers : {"filled", "both"})
      {
        const auto stretched = [&](std::vector<std::string> settings,
                                   const std::string       &cells,
                                   const DofVector         &q,
                                   const Vector3           &elongation) {
          settings.insert(settings.end(),
                          {"Stages=weave, relax, coat",
                           "Matrix/Layers=" + layers,
                           "Matrix/Cells along x=4",
                           "Matrix/Cells along y=" + cells,
                           "Matrix/Junction spacing=.03"});
          return Found(settings, q, elongation, 1e-4).energy;
        };
        checks.below("two periods, " + layers + ", energy",
                     stretched(two_periods, "8", both, twice_as_long) /
                         stretched({}, "4", cell.state.q, elongation) -
                       2,
                     1e-9);
      }
  }



  Matrix3
  stiffness(const Ended &cell)
  {
    return Eigen::Map<const Matrix3>(cell.stiffness.data());
  }



  void
  check_stiffness(Checks &checks)
  {
    const Matrix3 matrix =
      stiffness(run_cell({"Stages=weave, relax, stiffness"}));
    checks.below("symmetry of the stiffness",
                 relative_error(matrix, matrix.transpose()),
                 1e-6);
    checks.above(
      "least of its eigenvalues [N/mm]",
      Eigen::SelfAdjointEigenSolver<Matrix3>(matrix).eigenvalues()[0],
      0);
  }



  /** A matrix that fibers hardly feel is a plate beside the fabric. Friction
   * would tell that a fiber is not held in one place any more. */
  void
  check_plate(Checks &checks)
  {
    const Matrix3 dry = stiffness(run_cell(
      {"Stages=weave, relax, stiffness", "Contact/Friction coefficient=0"}));
    const double  E = 3000, nu = .35;
    const Ended   cell = run_cell({"Stages=weave, relax, coat, stiffness",
                                   "Matrix/Layers=filled",
                                   "Matrix/Cells along x=2",
                                   "Matrix/Cells along y=3",
                                   "Matrix/Young modulus=3000",
                                   "Matrix/Poisson ratio=.35",
                                   "Matrix/Junction stiffness=1e-6",
                                   "Contact/Friction coefficient=0"});
    Matrix3       plate;
    plate << 1, nu, 0, nu, 1, 0, 0, 0, .5 * (1 - nu);
    plate *= cell.thickness * E / (1 - nu * nu);
    checks.below("stiffness of a plate beside the fabric",
                 relative_error(stiffness(cell) - dry, plate),
                 1e-4);
  }



  void
  check_composites(Checks &checks)
  {
    const std::vector<std::string> coated{"Stages=weave, relax, coat, biaxial",
                                          "Matrix/Cells along x=4",
                                          "Matrix/Cells along y=4"};
    for (const std::string layers : {"filled", "both"})
      {
        auto settings = coated;
        settings.push_back("Matrix/Layers=" + layers);
        check_derivatives(checks, layers, run_cell(settings));
      }
  }
} // namespace



int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::ofstream                            output("output");
  Checks                                   checks(output);

  const Ended cell = run_cell({});
  check_derivatives(checks, "pulled", cell);
  // Without friction, which would hold what cells are compared without.
  check_cells(checks,
              run_cell({"Contact/Friction coefficient=0",
                        "Solver/Contact tolerance=1e-6"}));

  const Ended pressed = run_cell({"Stages=weave, relax, compact",
                                  "Compact/Thickness=.0315",
                                  "Compact/First step=.25",
                                  "Compact/Largest step=.25"});
  check_derivatives(checks, "pressed", pressed);
  checks.above("pressure [MPa]", pressed.last.at("pressure[MPa]"), 0);
  checks.equal("thickness", pressed.last.at("thickness[mm]"), .0315);

  check_stiffness(checks);
  check_plate(checks);
  check_composites(checks);
}
