// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// Fibers in a matrix: junctions without force where they are made and after
// any rigid motion of all, forces that balance; the system's residual is the
// slope of its energy and its matrix that of the residual, with nodes of the
// matrix on bodies that have turned.

#include <fiberloom/base/parameters.h>

#include <fiberloom/coupling/hold.h>

#include <fiberloom/model/system.h>

#include <fiberloom/simulation/refinement.h>

#include <deal.II/base/mpi.h>

#include <fstream>

#include "checks.h"
#include "sample_model.h"

using namespace fiberloom;

namespace
{
  MatrixParameters
  filled_matrix()
  {
    MatrixParameters matrix;
    matrix.layers           = Layers::filled;
    matrix.thickness        = 1;
    matrix.cells_along_x    = 3;
    matrix.cells_along_y    = 2;
    matrix.young_modulus    = .3;
    matrix.junction_spacing = .9;
    return matrix;
  }

  /** Three fibers in a block that a body turns at one border and another one
   * holds in part at the other. */
  struct SampleComposite
  {
    FiberSet                    fibers;
    FiberMesh                   mesh;
    MatrixParameters            parameters = filled_matrix();
    State                       state;
    std::unique_ptr<Composite>  composite;
    Supports                    supports;
    Targets                     targets;
    std::vector<ContactElement> no_contacts;

    SampleComposite()
      : fibers(loose_fibers({straight_fiber({-6, -3, 0}, {6, -2, 0}, 3),
                             straight_fiber({-6, 1, 1}, {6, 0, -1}, 3),
                             straight_fiber({-6, 4, 0}, {6, 4, 1}, 3)}))
      , mesh(fibers)
    {
      state.matrix.layers = build_layers(parameters, mesh, mesh.reference());
      state.matrix.degree = parameters.degree;
      state.matrix.law    = parameters.law;
      state.matrix.young_modulus = parameters.young_modulus;
      state.matrix.poisson_ratio = parameters.poisson_ratio;
      const Composite bare(state.matrix, mesh);
      state.matrix.junctions =
        find_junctions(parameters, mesh, bare.matrix(), mesh.reference())
          .junctions;
      composite = std::make_unique<Composite>(state.matrix, mesh);
      state.q.resize(mesh.reference().size() +
                     bare.matrix().reference().size());
      state.q << mesh.reference(), bare.matrix().reference();

      supports.bodies.resize(2);
      supports.bodies[0].prescribed.reset();
      hold(MatrixBorder::x_start, 0, 7);
      hold(MatrixBorder::x_end, 1, 5);
      supports.attachments.push_back(
        attach(state.q, mesh.lines()[1].first_node, 0, Hold::clamped));
      state.placements.resize(2);
      state.placements[0].position = Vector3(-7, 1, 2);
      state.placements[1].position = Vector3(6, -2, 1);
      targets.bodies.resize(2);
      set_targets();
    }

    void
    set_targets()
    {
      for (unsigned int b = 0; b < 2; ++b)
        targets.bodies[b].placement = state.placements[b];
    }

    /** Turns both bodies and disturbs all that is not held. */
    void
    disturb(const System &system, const double size)
    {
      std::srand(7);
      Eigen::VectorXd increment =
        size * Eigen::VectorXd::Random(system.layout().n_dofs());
      for (unsigned int dof = 0;
           dof < system.layout().first_dof(system.layout().body_block(0));
           ++dof)
        if (system.motion().is_fixed(dof))
          increment[dof] = 0;
      system.motion().advance(state, increment, 1);
      set_targets();
    }

    void
    move_rigidly()
    {
      const Eigen::AngleAxisd turn(1.3, Vector3(1, 2, -1).normalized());
      const Vector3           shift(3, -1, 2);
      for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
        for (const unsigned int v : {0, 3, 6})
          {
            auto vector = state.q.segment<3>(9 * n + v);
            vector =
              (turn * vector + (v == 0 ? shift : Vector3::Zero())).eval();
          }
      for (Eigen::Index i = mesh.reference().size(); i < state.q.size(); i += 3)
        state.q.segment<3>(i) =
          (turn * Vector3(state.q.segment<3>(i)) + shift).eval();
      for (Placement &placement : state.placements)
        {
          placement.position = turn * placement.position + shift;
          placement.rotation = turn * placement.rotation;
        }
      set_targets();
    }

  private:
    void
    hold(const MatrixBorder border, const unsigned int body, const int held)
    {
      for (const unsigned int node : composite->matrix().border_nodes(border))
        {
          Attachment attachment;
          attachment.node = composite->first_node() + node;
          attachment.body = body;
          attachment.held = held;
          supports.attachments.push_back(attachment);
        }
    }
  };

  void
  check_junctions(Checks &checks)
  {
    SampleComposite    sample;
    const auto        &composite = *sample.composite;
    const unsigned int n         = composite.junctions().size();
    checks.equal("junctions", n, 40);
    double length = 0, stiffness = 0, largest = 0;
    for (const auto &line : sample.mesh.lines())
      length += line.length;
    for (unsigned int j = 0; j < n; ++j)
      {
        stiffness += composite.junctions()[j].spring();
        largest =
          std::max(largest, composite.junction_force(j, sample.state.q).norm());
      }
    checks.below("force of junctions where they are made", largest, 1e-12);
    checks.below("stiffness per length over 2 pi G/ln 4",
                 stiffness / length / (2 * M_PI * .3 / 2.7 / std::log(4.)) - 1,
                 1e-12);

    System system(sample.mesh, sample.supports, MPI_COMM_WORLD, &composite);
    system.reinit({});
    sample.disturb(system, .1);
    // Nodal forces of one junction: no sum, no moment.
    const JunctionElement &junction = composite.junctions()[5];
    const Vector3          force = composite.junction_force(5, sample.state.q);
    const auto            &weights = junction.weights();
    double                 center = 0, matrix = 0;
    for (unsigned int a = 0; a < 3; ++a)
      center += weights[3 * a];
    for (unsigned int b = 9; b < weights.size(); ++b)
      matrix += weights[b];
    checks.above("force of a disturbed junction", force.norm(), 1e-3);
    checks.below("sum of what acts on fiber and matrix",
                 center + matrix,
                 1e-14);
    checks.below("moment of both particles' forces",
                 (junction.fiber_particle(sample.state.q) -
                  junction.matrix_particle(
                    composite.positions(sample.state.q)) +
                  force / junction.spring())
                   .norm(),
                 1e-14);
  }

  void
  check_rigid_motion(Checks &checks)
  {
    SampleComposite sample;
    System          system(sample.mesh,
                  sample.supports,
                  MPI_COMM_WORLD,
                  sample.composite.get());
    system.reinit({});
    sample.move_rigidly();
    system.assemble_residual(sample.state, sample.targets, sample.no_contacts);
    checks.below("residual of the turned composite",
                 system.residual_norm(),
                 1e-12);
    for (unsigned int b = 0; b < 2; ++b)
      checks.below("reaction of its body " + std::to_string(b),
                   system.reactions()[b].norm(),
                   1e-12);
    checks.below("its energy",
                 system.energy(sample.state, sample.no_contacts),
                 1e-12);
  }

  void
  check_derivatives(Checks &checks)
  {
    SampleComposite sample;
    System          system(sample.mesh,
                  sample.supports,
                  MPI_COMM_WORLD,
                  sample.composite.get());
    system.reinit({});
    sample.disturb(system, .03);
    system.assemble(sample.state, sample.targets, sample.no_contacts);
    const unsigned int    n = system.layout().n_dofs();
    const Eigen::VectorXd residual =
      -Eigen::Map<const Eigen::VectorXd>(system.right_hand_side().data(), n);

    std::srand(9);
    Eigen::VectorXd direction = Eigen::VectorXd::Random(n);
    for (unsigned int i = 0; i < n; ++i)
      if (system.motion().is_fixed(i))
        direction[i] = 0;
    const double h        = 1e-6;
    const auto   moved_by = [&](const double factor) {
      State moved = sample.state;
      system.motion().advance(moved, direction, factor);
      return moved;
    };
    const double slope = (system.energy(moved_by(h), sample.no_contacts) -
                          system.energy(moved_by(-h), sample.no_contacts)) /
                         (2 * h);
    checks.below("slope of the energy over the residual",
                 slope / residual.dot(direction) - 1,
                 1e-7);

    // Twice along lines of the unknowns: sections that turn are moved along
    // curves.
    const auto moved_straight = [&](const double factor) {
      State moved = moved_by(factor);
      for (unsigned int n = 0; n < sample.mesh.n_nodes(); ++n)
        if (system.motion().holding_body(n) < 0)
          moved.q.segment<9>(9 * n) = sample.state.q.segment<9>(9 * n) +
                                      factor * direction.segment<9>(9 * n);
      return moved;
    };
    double error = 0;
    for (unsigned int line = 0; line < 5; ++line)
      {
        const double H = 1e-3;
        const double curvature =
          (system.energy(moved_straight(H), sample.no_contacts) -
           2 * system.energy(sample.state, sample.no_contacts) +
           system.energy(moved_straight(-H), sample.no_contacts)) /
          (H * H);
        const double expected = direction.dot(multiply(system, direction));
        error = std::max(error, std::abs(curvature / expected - 1));
        for (unsigned int i = 0; i < n; ++i)
          direction[i] *= std::sin(i + line);
      }
    checks.below("curvature of the energy over the matrix", error, 1e-4);
  }
} // namespace

namespace
{
  /** No junction feels that meshes got finer. */
  void
  check_transfer(Checks &checks)
  {
    SampleComposite sample;
    System          system(sample.mesh,
                  sample.supports,
                  MPI_COMM_WORLD,
                  sample.composite.get());
    sample.disturb(system, .1);
    const Parameters parameters;
    const Scene      scene{parameters,
                      sample.fibers,
                      sample.mesh,
                      sample.composite.get()};
    const FiberMesh  finer_fibers(
      loose_fibers({straight_fiber({-6, -3, 0}, {6, -2, 0}, 6),
                     straight_fiber({-6, 1, 1}, {6, 0, -1}, 6),
                     straight_fiber({-6, 4, 0}, {6, 4, 1}, 6)}));
    for (const bool cells : {true, false})
      {
        const Refinement refinement{cells ? 1u : 2u, 1, 1, cells ? 2u : 1u};
        const FiberMesh &fibers = cells ? sample.mesh : finer_fibers;
        const Transfer transfer(scene, sample.state.matrix, fibers, refinement);
        const State    finer       = transfer(sample.state);
        const Composite &composite = *transfer.finer();
        double           change = 0, largest = 0;
        for (unsigned int j = 0; j < composite.junctions().size(); ++j)
          {
            const Vector3 force =
              sample.composite->junction_force(j, sample.state.q);
            largest = std::max(largest, force.norm());
            change =
              std::max(change,
                       (composite.junction_force(j, finer.q) - force).norm());
          }
        const std::string what = cells ? "finer cells" : "finer fibers";
        checks.equal(what + ", cells",
                     double(composite.matrix().n_cells()) /
                       sample.composite->matrix().n_cells(),
                     cells ? 8 : 1);
        checks.above(what + ", largest force of a junction", largest, 1e-3);
        checks.below(what + ", its change", change / largest, 1e-10);
      }
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::ofstream                            output("output");
  Checks                                   checks(output);
  check_junctions(checks);
  check_rigid_motion(checks);
  check_derivatives(checks);
  check_transfer(checks);
}
