// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// The Krylov method around a factor in single precision, of the whole or of the
// motions of rigid sections, finds what the one in double precision finds; an
// indefinite matrix, that of a fiber compressed beyond buckling, is noticed and
// gets a shift that makes the step a descent; multipliers keep each fiber
// within its bound.

#include <fiberloom/solvers/fiber_bounds.h>
#include <fiberloom/solvers/linear_solver.h>

#include <deal.II/base/mpi.h>

#include <fstream>

#include "checks.h"
#include "sample_model.h"

using namespace fiberloom;

namespace
{
  using Outcome = LinearSolver::Outcome;

  Eigen::VectorXd
  solve(System                &system,
        const Eigen::VectorXd &q,
        const Preconditioning  wanted,
        const double           shift_unit,
        Outcome               &outcome)
  {
    std::vector<double> solution;
    LinearSolver        solver(system, wanted);
    outcome = solver.solve({system.matrix(), system.right_hand_side()},
                           q,
                           {0, shift_unit},
                           solution);
    return system.gather(solution);
  }

  /** |b - K x| / |b| */
  double
  remainder(System &system, const Eigen::VectorXd &solution)
  {
    const Eigen::VectorXd b = system.gather(system.right_hand_side());
    return (b - multiply(system, solution)).norm() / b.norm();
  }

  /** Of disturbed fibers that lie in each other. */
  void
  assemble(SampleModel &model, System &system)
  {
    model.disturb(system);
    model.add_contacts(.02, .001);
    system.reinit(model.contacts);
    system.assemble(model.state, model.targets, model.contacts);
  }

  void
  check_precision(Checks &checks)
  {
    SampleModel model(4);
    model.supports.bodies[1].prescribed.set();
    System system(model.mesh, model.supports, MPI_COMM_WORLD);
    model.disturb(system);
    model.add_contacts(.02, .001);
    for (const double x : {0., .3})
      {
        // The second time other contacts, and so another pattern.
        if (x > 0)
          model.contacts.erase(model.contacts.begin());
        system.reinit(model.contacts);
        system.assemble(model.state, model.targets, model.contacts);
        Outcome               with_double, with_single, with_multigrid;
        const double          unit      = 1e-3;
        const Eigen::VectorXd exact     = solve(system,
                                            model.state.q,
                                            Preconditioning::double_factor,
                                            unit,
                                            with_double);
        const Eigen::VectorXd found     = solve(system,
                                            model.state.q,
                                            Preconditioning::single_factor,
                                            unit,
                                            with_single);
        const Eigen::VectorXd coarsened = solve(system,
                                                model.state.q,
                                                Preconditioning::multigrid,
                                                unit,
                                                with_multigrid);
        Outcome               with_sections;
        const Eigen::VectorXd split = solve(system,
                                            model.state.q,
                                            Preconditioning::rigid_sections,
                                            unit,
                                            with_sections);
        checks.below("remainder, rigid sections",
                     remainder(system, split),
                     1e-8);
        checks.below("rigid sections against double",
                     relative_error(split, exact),
                     1e-7);
        checks.equal("factorisations, rigid sections",
                     with_sections.factorizations,
                     1);
        checks.above("iterations, rigid sections", with_sections.iterations, 2);
        checks.below("iterations, rigid sections",
                     with_sections.iterations,
                     25);
        checks.below("remainder, multigrid",
                     remainder(system, coarsened),
                     1e-8);
        checks.equal("factorisations, multigrid",
                     with_multigrid.factorizations,
                     0);
        checks.above("iterations, multigrid", with_multigrid.iterations, 8);
        checks.equal("shift", with_double.shift + with_single.shift, 0);
        checks.below("remainder, double", remainder(system, exact), 1e-8);
        checks.below("remainder, single", remainder(system, found), 1e-8);
        checks.below("single against double",
                     relative_error(found, exact),
                     1e-8);
        checks.below("iterations, double", with_double.iterations, 3);
        checks.above("iterations, single", with_single.iterations, 1);
        checks.below("iterations, single", with_single.iterations, 8);
      }
  }

  /** Springs so stiff that only a factor in double precision knows of the
   * fibers beside them. */
  void
  check_fallback(const Preconditioning wanted, Checks &checks)
  {
    SampleModel model(4);
    model.supports.bodies[1].prescribed.set();
    System system(model.mesh, model.supports, MPI_COMM_WORLD);
    model.disturb(system);
    model.add_contacts(1e-7, .001);
    for (ContactElement &contact : model.contacts)
      contact.stiffness *= 1e11;
    system.reinit(model.contacts);
    system.assemble(model.state, model.targets, model.contacts);

    std::vector<double> solution;
    LinearSolver        solver(system, wanted);
    bool                first = true;
    for (const std::string time :
         {"the first time", "the second time", "after forgetting"})
      {
        if (time == "after forgetting")
          {
            solver.forget();
            first = true;
          }
        const Outcome outcome =
          solver.solve({system.matrix(), system.right_hand_side()},
                       model.state.q,
                       {0, 1e-9},
                       solution);
        const std::string which = ", " + name_of(wanted) + ", " + time;
        checks.that("gave way" + which + ": " + (first ? "yes" : "no"),
                    (outcome.factorizations > 1) == first);
        checks.equal("shift" + which, outcome.shift, 0);
        checks.below("remainder" + which,
                     remainder(system, system.gather(solution)),
                     1e-8);
        first = false;
      }
  }

  /** Low-rank blocks are left out where nothing is damped, and are there again
   * where something is, whenever the analysis was. */
  void
  check_damped_after_undamped(Checks &checks)
  {
    SampleModel model(4);
    model.supports.bodies[1].prescribed.set();
    System system(model.mesh, model.supports, MPI_COMM_WORLD);
    assemble(model, system);
    LinearSolver        solver(system, Preconditioning::rigid_sections);
    std::vector<double> solution;
    for (const double damping : {0., 0., 1e-3})
      {
        const Outcome outcome =
          solver.solve({system.matrix(), system.right_hand_side()},
                       model.state.q,
                       {damping, 1e-3},
                       solution);
        checks.equal("factorisations, damped by " + std::to_string(damping),
                     outcome.factorizations,
                     1);
        if (damping == 0)
          solver.forget();
      }
  }

  /** What is solved for roughly is where a finer solution starts. */
  void
  check_improving(Checks &checks)
  {
    SampleModel model(4);
    model.supports.bodies[1].prescribed.set();
    System system(model.mesh, model.supports, MPI_COMM_WORLD);
    assemble(model, system);
    LinearSolver solver(system, Preconditioning::rigid_sections);
    Outcome      of_factor;
    solver.factorize(system.matrix(), model.state.q, of_factor);
    std::vector<double> solution;
    const auto          iterations = [&](const double tolerance) {
      Outcome    outcome;
      const bool found = solver.solve_coupled({system.matrix(),
                                               system.right_hand_side(),
                                               tolerance},
                                              solution,
                                              outcome);
      checks.that("found to " + std::to_string(tolerance), found);
      checks.below("remainder over it",
                   remainder(system, system.gather(solution)) / tolerance,
                   1.0001);
      return outcome.iterations;
    };
    const unsigned int rough = iterations(1e-2), further = iterations(1e-6);
    checks.equal("iterations from the solution", iterations(1e-6), 0);
    solution.clear();
    const unsigned int all = iterations(1e-6);
    checks.that("the rough solution counts", rough > 0 && further < all);
  }

  /** Patterns with hardly more than is needed are kept, with their analysis. */
  void
  check_pattern(Checks &checks)
  {
    SampleModel model(4);
    System      system(model.mesh, model.supports, MPI_COMM_WORLD);
    model.disturb(system);
    model.add_contacts(.02, .001);
    system.reinit(model.contacts);
    const unsigned int all      = system.matrix().pattern_version();
    const auto         contacts = model.contacts;
    system.reinit(contacts);
    checks.equal("versions for the same contacts",
                 system.matrix().pattern_version() - all,
                 0);
    system.reinit({});
    checks.equal("for none", system.matrix().pattern_version() - all, 1);
    system.reinit(contacts);
    checks.equal("for all again", system.matrix().pattern_version() - all, 2);
    system.assemble(model.state, model.targets, model.contacts);
    const DofVector       x = DofVector::Random(system.layout().n_dofs());
    const Eigen::VectorXd y = multiply(system, x);
    system.reinit(contacts);
    system.assemble(model.state, model.targets, model.contacts);
    checks.below("product with the pattern kept",
                 relative_error(multiply(system, x), y),
                 1e-14);
  }

  /** Of contacts that close on the same pattern a factor has to learn: it
   * leaves out those that are open. */
  void
  check_closing(Checks &checks)
  {
    constexpr double gap = .02;
    SampleModel      model(4);
    model.supports.bodies[1].prescribed.set();
    System system(model.mesh, model.supports, MPI_COMM_WORLD);
    model.disturb(system);
    model.add_contacts(-gap, .001);
    system.reinit(model.contacts);
    const unsigned int pattern = system.matrix().pattern_version();

    LinearSolver        solver(system, Preconditioning::double_factor);
    std::vector<double> solution;
    for (const unsigned int closed : {0, 1, 2, 0, 2})
      {
        auto contacts = model.contacts;
        for (unsigned int c = 0; c < closed; ++c)
          contacts[c].offset -= 2 * gap;
        system.reinit(contacts);
        system.assemble(model.state, model.targets, contacts);
        const Outcome outcome =
          solver.solve({system.matrix(), system.right_hand_side()},
                       model.state.q,
                       {0, 1e-3},
                       solution);
        const std::string name = ", contacts closed: " + std::to_string(closed);
        checks.equal("new patterns" + name,
                     system.matrix().pattern_version() - pattern,
                     0);
        checks.below("remainder" + name,
                     remainder(system, system.gather(solution)),
                     1e-8);
        checks.below("iterations" + name, outcome.iterations, 3);
      }
  }

  /** A clamped fiber, shortened by @p strain , under a small load across. */
  void
  check_buckling(Checks &checks)
  {
    const double    L = 60;
    const FiberMesh mesh(
      loose_fibers({straight_fiber({0, 0, 0}, {L, 0, 0}, 6, 0.)}));
    Supports supports;
    supports.bodies.resize(2);
    supports.attachments = {attach(mesh.reference(), 0, 0, Hold::clamped),
                            attach(mesh.reference(), 12, 1, Hold::clamped)};
    System system(mesh, supports, MPI_COMM_WORLD);
    system.reinit({});

    // Euler's load of a beam clamped twice, 4 pi^2 EI / L^2, as a strain.
    const double euler = M_PI * M_PI / (L * L);
    for (const double part : {.8, 1.2, 30.})
      {
        State state;
        state.q = mesh.reference();
        state.placements.resize(2);
        std::vector<BodyTarget> targets(2);
        for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
          {
            state.q[9 * n] *= 1 - part * euler;
            state.q[9 * n + 2] += n * (12. - n) * 1e-5;
          }
        state.placements[1].position.x() = L * (1 - part * euler);
        targets[1].placement             = state.placements[1];

        std::vector<ContactElement> none;
        system.assemble(state, targets, none);
        const Eigen::VectorXd down = system.gather(system.right_hand_side());
        for (const Preconditioning wanted :
             {Preconditioning::double_factor, Preconditioning::rigid_sections})
          {
            system.assemble(state, targets, none); // without earlier shifts
            Outcome               outcome;
            const Eigen::VectorXd step =
              solve(system, state.q, wanted, 1e-7, outcome);
            const std::string name = name_of(wanted) + ", compressed to " +
                                     std::to_string(part) +
                                     " times Euler's load";
            checks.that(name + ", shifted: " + (part > 1 ? "yes" : "no"),
                        (outcome.shift > 0) == (part > 1));
            checks.above(name + ", slope along the step",
                         step.dot(down) / (step.norm() * down.norm()),
                         1e-6);
            checks.that(name + ", factorised more than once: " +
                          (part > 1 ? "yes" : "no"),
                        (outcome.factorizations > 1) == (part > 1));
          }
      }
  }

  /** Fibers that would go five times as far as they may. */
  void
  check_bounds(Checks &checks)
  {
    SampleModel model(4);
    for (auto &body : model.supports.bodies)
      body.prescribed.set();
    System system(model.mesh, model.supports, MPI_COMM_WORLD);
    assemble(model, system);
    const std::vector<double> gradient = system.right_hand_side();
    LinearSolver              solver(system, Preconditioning::double_factor);
    std::vector<double>       step;
    const auto                solve_again = [&]() {
      solver.solve({system.matrix(), gradient}, model.state.q, {0, 1e-3}, step);
      return system.gather(step);
    };
    Eigen::VectorXd increment = solve_again();
    const double    allowed   = system.motion().largest_move(increment) / 5;
    FiberBounds     bounds(model.mesh, system, allowed);
    checks.that("nothing is held at first", !bounds.hold_any());
    for (unsigned int k = 0; k < 4; ++k)
      {
        bounds.hold(gradient, step, increment);
        increment = solve_again();
      }
    checks.that("then something is", bounds.hold_any());
    const double over = system.motion().largest_move(increment) / allowed;
    checks.below("move over its bound", over, 1.05);
    checks.above("move over its bound", over, .8);

    // The next matrix gets the same.
    system.assemble(model.state, model.targets, model.contacts);
    bounds.add_to_matrix();
    checks.below("step by the next matrix",
                 relative_error(solve_again(), increment),
                 1e-8);

    system.assemble(model.state, model.targets, model.contacts);
    increment = solve_again();
    bounds.cut(step, increment);
    checks.below("what is cut, over its bound",
                 system.motion().largest_move(system.gather(step)) / allowed,
                 1 + 1e-12);

    bounds.release();
    checks.that("nothing is held in the end", !bounds.hold_any());
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::ofstream                            output;
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    output.open("output");
  Checks checks(output);
  check_precision(checks);
  check_fallback(Preconditioning::single_factor, checks);
  check_fallback(Preconditioning::rigid_sections, checks);
  check_damped_after_undamped(checks);
  check_improving(checks);
  check_pattern(checks);
  check_closing(checks);
  check_buckling(checks);
  check_bounds(checks);
}
