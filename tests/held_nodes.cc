// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// The system of equations with nodes held by rigid bodies that have turned far:
// its residual is the slope of the energy along its unknowns, its matrix the
// slope of the residual, also where it is restricted to one fiber, held nodes
// keep what is held, and the reactions of the bodies balance the forces on the
// nodes.

#include <deal.II/base/mpi.h>

#include <fstream>

#include "checks.h"
#include "sample_model.h"

using namespace fiberloom;

namespace
{
  /** Turns both bodies by more than a quarter and disturbs all else. */
  void
  move_far(SampleModel &model, const System &system)
  {
    std::srand(3);
    const unsigned int n = system.layout().n_dofs();
    for (unsigned int step = 0; step < 3; ++step)
      {
        Eigen::VectorXd increment = .1 * Eigen::VectorXd::Random(n);
        for (const auto &attachment : model.supports.attachments)
          for (unsigned int k = 0; k < 9; ++k)
            if (attachment.held[k])
              increment[9 * attachment.node + k] = 0;
        for (unsigned int b = 0; b < 2; ++b)
          {
            const unsigned int first =
              system.layout().first_dof(system.layout().body_block(b));
            increment.segment<6>(first) << .3, -.2, .4, .7, .4 * b, -.5;
          }
        system.motion().advance(model.state, increment, 1);
      }
    for (unsigned int b = 0; b < 2; ++b)
      model.targets.bodies[b].placement = model.state.placements[b];
  }

  /** Components along the frames of what the bodies hold. */
  std::vector<double>
  held_components(const SampleModel &model)
  {
    std::vector<double> values;
    for (const auto &attachment : model.supports.attachments)
      {
        const Placement &body     = model.state.placements[attachment.body];
        const Matrix3    rotation = body.rotation.toRotationMatrix();
        for (unsigned int k = 0; k < 9; ++k)
          if (attachment.held[k])
            {
              const Matrix3 frame =
                rotation * (k < 3 ? attachment.center_frame : attachment.frame);
              Vector3 v =
                model.state.q.segment<3>(9 * attachment.node + k / 3 * 3);
              if (k < 3)
                v -= body.position;
              values.push_back(frame.col(k % 3).dot(v));
            }
      }
    return values;
  }

  /** A step that turns the sections of free nodes keeps their shape, one that
   * stretches them is as long as it says. */
  void
  check_sections(Checks &checks, const SampleModel &model, const System &system)
  {
    using Section = Eigen::Matrix<double, 3, 2>;
    const Vector3   turn(.3, -.1, .2);
    Eigen::VectorXd turned    = Eigen::VectorXd::Zero(system.layout().n_dofs());
    Eigen::VectorXd stretched = turned;
    const auto      section   = [](const Eigen::VectorXd &q,
                            const unsigned int     n) -> Section {
      return Eigen::Map<const Section>(q.data() + 9 * n + 3);
    };
    const unsigned int n_nodes = model.mesh.n_nodes();
    for (unsigned int n = 0; n < n_nodes; ++n)
      if (system.motion().holding_body(n) < 0)
        for (unsigned int v = 0; v < 2; ++v)
          {
            const Vector3 g = model.state.q.segment<3>(9 * n + 3 + 3 * v);
            turned.segment<3>(9 * n + 3 + 3 * v)    = turn.cross(g);
            stretched.segment<3>(9 * n + 3 + 3 * v) = .1 * g;
          }
    State turns = model.state, stretches = model.state;
    system.motion().advance(turns, turned, 1);
    system.motion().advance(stretches, stretched, 1);
    double change = 0, missed = 0;
    for (unsigned int n = 0; n < n_nodes; ++n)
      if (system.motion().holding_body(n) < 0)
        {
          const Section was = section(model.state.q, n),
                        is  = section(turns.q, n);
          change =
            std::max(change,
                     (is.transpose() * is - was.transpose() * was).norm() /
                       was.squaredNorm());
          missed =
            std::max(missed,
                     (section(stretches.q, n) - 1.1 * was).norm() / was.norm());
        }
    checks.below("shape of sections that turn", change, 1e-12);
    checks.below("stretch of sections over the step's", missed, 1e-12);
  }

  /** One increment further, from what the last one was. */
  void
  check_extrapolation(Checks            &checks,
                      const SampleModel &model,
                      const System      &system)
  {
    std::srand(4);
    Eigen::VectorXd increment =
      1e-4 * Eigen::VectorXd::Random(system.layout().n_dofs());
    for (const auto &attachment : model.supports.attachments)
      for (unsigned int k = 0; k < 9; ++k)
        if (attachment.held[k])
          increment[9 * attachment.node + k] = 0;
    const auto moved = [&](const State &from, const double factor) {
      State state = from;
      system.motion().advance(state, increment, factor);
      return state;
    };

    State      state = moved(model.state, 1);
    const Past past{model.state.q, model.state.placements, 0};
    state.load           = 2;
    const State expected = moved(state, .5);
    Targets     targets  = model.targets;
    for (unsigned int b = 0; b < 2; ++b)
      targets.bodies[b].placement = expected.placements[b];
    const DofVector start = state.q;
    system.motion().extrapolate(state, past, targets, 1);
    checks.below("extrapolation of an increment",
                 relative_error(state.q - start, expected.q - start),
                 1e-3);
  }

  class Differences
  {
  public:
    Differences(SampleModel &model, System &system)
      : model(model)
      , system(system)
      , n(system.layout().n_dofs())
      , is_free(n, true)
    {
      for (const auto &attachment : model.supports.attachments)
        for (unsigned int k = 0; k < 9; ++k)
          if (attachment.held[k])
            is_free[9 * attachment.node + k] = false;
      for (unsigned int b = 0; b < 2; ++b)
        for (unsigned int k = 0; k < 6; ++k)
          if (model.supports.bodies[b].prescribed[k])
            is_free[system.layout().first_dof(system.layout().body_block(b)) +
                    k] = false;
    }

    /** The residual of free dofs, 0 elsewhere. */
    Eigen::VectorXd
    residual(const State &state)
    {
      auto contacts = model.contacts;
      auto targets  = model.targets;
      for (unsigned int b = 0; b < 2; ++b)
        targets.bodies[b].placement = state.placements[b];
      system.assemble(state, targets, contacts);
      return -Eigen::Map<const Eigen::VectorXd>(system.right_hand_side().data(),
                                                n);
    }

    Eigen::MatrixXd
    matrix()
    {
      residual(model.state);
      Eigen::MatrixXd K(n, n);
      for (unsigned int i = 0; i < n; ++i)
        K.col(i) =
          multiply(system, double(is_free[i]) * Eigen::VectorXd::Unit(n, i));
      return K;
    }

    State
    moved(const unsigned int dof, const double by) const
    {
      State state = model.state;
      system.motion().advance(state, Eigen::VectorXd::Unit(n, dof), by);
      return state;
    }

    Eigen::VectorXd
    energy_slope() const
    {
      Eigen::VectorXd slope = Eigen::VectorXd::Zero(n);
      for (unsigned int i = 0; i < n; ++i)
        if (is_free[i])
          slope[i] =
            (system.energy(moved(i, h), model.contacts) -
             system.energy(moved(i, -h), model.contacts)) /
              (2 * h) -
            (system.load_work(model.targets, moved(i, -h), moved(i, h))) /
              (2 * h);
      return slope;
    }

    /**
     * The rotation vectors of the residual start anew at each placement, which
     * adds to its slope half the cross product with the internal moment:
     * antisymmetric, and in equilibrium that of the moment from outside.
     */
    Eigen::MatrixXd
    residual_slope()
    {
      Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(n, n);
      for (unsigned int i = 0; i < n; ++i)
        if (is_free[i])
          slope.col(i) =
            (residual(moved(i, h)) - residual(moved(i, -h))) / (2 * h);
      return slope;
    }

  private:
    static constexpr double h = 1e-5;

    SampleModel       &model;
    System            &system;
    const unsigned int n;
    std::vector<bool>  is_free;
  };

  /** Bodies' reactions and the forces on the nodes that are not held. */
  void
  check_reactions(Checks            &checks,
                  const SampleModel &model,
                  const System      &system)
  {
    Vector3     force = Vector3::Zero(), moment = Vector3::Zero();
    double      scale = 0;
    const auto &rhs   = system.right_hand_side();
    for (unsigned int n = 0; n < model.mesh.n_nodes(); ++n)
      {
        const Vector3 outer = model.targets.node_forces[n];
        force += outer;
        moment += Vector3(model.state.q.segment<3>(9 * n)).cross(outer);

        bool held = false;
        for (const auto &attachment : model.supports.attachments)
          held |= attachment.node == n;
        if (held)
          continue;
        for (unsigned int v = 0; v < 3; ++v)
          {
            const Eigen::Map<const Vector3> f(rhs.data() + 9 * n + 3 * v);
            const Vector3 x = model.state.q.segment<3>(9 * n + 3 * v);
            if (v == 0)
              force -= f;
            moment -= x.cross(f);
            scale = std::max(scale, f.norm());
          }
      }
    for (unsigned int b = 0; b < 2; ++b)
      {
        const Vector3 f = system.reactions()[b].head<3>();
        force += f;
        moment += model.state.placements[b].position.cross(f) +
                  Vector3(system.reactions()[b].tail<3>());
        checks.above("reaction of body " + std::to_string(b) +
                       " over the forces",
                     f.norm() / scale,
                     .1);
      }
    checks.below("forces balance", force.norm() / scale, 1e-10);
    checks.below("moments balance", moment.norm() / scale, 1e-10);
  }

  /** A system restricted to the last fiber is right in its rows, and only
   * there. */
  void
  check_restricted(Checks &checks, SampleModel &model, System &system)
  {
    const auto        &line = model.mesh.lines()[2];
    const unsigned int i = 9 * line.first_node, n = 9 * line.n_nodes();
    Differences        differences(model, system);
    const auto         gain = [&]() {
      return system.energy(differences.moved(i + n / 2, .01), model.contacts) -
             system.energy(model.state, model.contacts);
    };
    const Eigen::VectorXd residual = differences.residual(model.state);
    const Eigen::MatrixXd K        = differences.matrix();
    const double          energy   = gain();

    std::vector<char> blocks(system.layout().n_blocks(), false);
    std::fill_n(blocks.begin() + line.first_node, line.n_nodes(), true);
    system.restrict_to(blocks);
    system.reinit(model.contacts);
    const Eigen::VectorXd its_residual = differences.residual(model.state);
    const Eigen::MatrixXd its_K        = differences.matrix();
    checks.below("restricted: residual of the fiber",
                 relative_error(its_residual.segment(i, n),
                                residual.segment(i, n)),
                 1e-12);
    checks.below("restricted: rows of the fiber",
                 relative_error(its_K.middleRows(i, n), K.middleRows(i, n)),
                 1e-12);
    checks.below("restricted: gain of energy",
                 std::abs(gain() / energy - 1),
                 1e-8);
    checks.below("restricted: rows of the first fiber",
                 its_K.topRows(9).norm() / K.topRows(9).norm(),
                 .5);
    system.restrict_to({});
    system.reinit(model.contacts);
    checks.below("all again: matrix",
                 relative_error(differences.matrix(), K),
                 1e-12);
  }

  /**
   * A section that spins but may not tilt one way. Its unknowns turn with it,
   * so that the matrix is compared with second differences of the potential.
   */
  void
  check_radial(Checks &checks)
  {
    SampleModel        model;
    const unsigned int node = model.mesh.lines()[2].first_node + 2;
    model.supports.attachments.push_back(
      attach(model.state.q, node, 1, "z radial", Vector3(0, 0, 5)));
    System system(model.mesh, model.supports, MPI_COMM_WORLD);
    move_far(model, system);
    const Attachment &held  = model.supports.attachments.back();
    const Vector3     first = model.state.q.segment<3>(9 * node + 3),
                  second    = model.state.q.segment<3>(9 * node + 6),
                  radial    = model.state.placements[1].rotation * held.radial;
    checks.below("tilt along radial",
                 first.cross(second).normalized().dot(radial),
                 1e-12);
    checks.above("spin of the section against radial",
                 second.normalized().dot(radial),
                 .1);

    system.reinit({});
    const Eigen::MatrixXd     K = Differences(model, system).matrix();
    std::vector<unsigned int> dofs;
    for (unsigned int k = 0; k < 9; ++k)
      if (!held.held[k])
        dofs.push_back(9 * node + k);
    for (unsigned int k = 0; k < 6; ++k)
      {
        dofs.push_back(
          system.layout().first_dof(system.layout().body_block(0)) + k);
        if (!model.supports.bodies[1].prescribed[k])
          dofs.push_back(
            system.layout().first_dof(system.layout().body_block(1)) + k);
      }

    const double h         = 1e-4;
    const auto   potential = [&](const unsigned int i,
                               const double       by_i,
                               const unsigned int j,
                               const double       by_j) {
      Eigen::VectorXd increment = Eigen::VectorXd::Zero(K.rows());
      increment[i] += by_i;
      increment[j] += by_j;
      State moved = model.state;
      system.motion().advance(moved, increment, 1);
      return system.energy(moved, {}) -
             system.load_work(model.targets, model.state, moved);
    };
    double error = 0, scale = 0;
    for (const unsigned int i : dofs)
      for (const unsigned int j : dofs)
        {
          const double slope =
            (potential(i, h, j, h) - potential(i, h, j, -h) -
             potential(i, -h, j, h) + potential(i, -h, j, -h)) /
            (4 * h * h);
          error = std::max(error, std::abs(K(i, j) - slope));
          scale = std::max(scale, std::abs(slope));
        }
    checks.below("radial: matrix against the potential", error / scale, 1e-5);
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::ofstream                            output("output");
  Checks                                   checks(output);

  SampleModel model;
  System      system(model.mesh, model.supports, MPI_COMM_WORLD);
  const auto  before = held_components(model);
  move_far(model, system);
  const auto after = held_components(model);
  double     slip  = 0;
  for (unsigned int i = 0; i < before.size(); ++i)
    slip = std::max(slip, std::abs(after[i] - before[i]));
  checks.equal("held dofs", before.size(), 7 + 7 + 4 + 5 + 1 + 3);
  checks.below("held dofs move with their bodies", slip, 1e-12);
  for (const Placement &placement : model.state.placements)
    checks.above("body turned by",
                 placement.rotation.angularDistance(
                   Eigen::Quaterniond::Identity()),
                 1.5);

  check_extrapolation(checks, model, system);

  system.reinit({});
  Differences differences(model, system);
  differences.residual(model.state);
  check_reactions(checks, model, system);

  // Contact acts at elements with held nodes; friction moves bodies, too.
  model.add_contacts(.1, .01);
  system.reinit(model.contacts);
  const Eigen::VectorXd residual = differences.residual(model.state);
  checks.below("residual against energy",
               relative_error(residual, differences.energy_slope()),
               1e-7);
  const Eigen::MatrixXd K = differences.matrix();
  checks.below("symmetry of the matrix",
               relative_error(K, K.transpose()),
               1e-12);
  const Eigen::MatrixXd slope = differences.residual_slope();
  checks.below("matrix against residual",
               relative_error(K, .5 * (slope + slope.transpose())),
               1e-6);
  check_restricted(checks, model, system);

  differences.residual(model.state);
  for (unsigned int b = 0; b < 2; ++b)
    model.targets.bodies[b].load.tail<3>() = system.reactions()[b].tail<3>();
  const Eigen::MatrixXd loaded = differences.matrix();
  checks.above("moments make the matrix unsymmetric by",
               relative_error(loaded, loaded.transpose()),
               1e-3);
  checks.below("matrix against residual, with balanced moments",
               relative_error(loaded, slope),
               1e-6);
  check_radial(checks);
  check_sections(checks, model, system);
}
