// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_solvers_equilibrium_h
#define fiberloom_solvers_equilibrium_h

#include <fiberloom/base/statistics.h>

#include <fiberloom/contact/contact_generator.h>

#include <fiberloom/model/system.h>

#include <fiberloom/solvers/damping.h>
#include <fiberloom/solvers/increment.h>
#include <fiberloom/solvers/linear_solver.h>
#include <fiberloom/solvers/newton.h>
#include <fiberloom/solvers/penetration.h>

#include <array>
#include <vector>

namespace fiberloom
{
  struct Parameters;

  /**
   * Finds the equilibrium of an increment by the three nested loops of section
   * 3.6 of the paper: on contact generation, on contact normals with friction
   * limits, and Newton's method on all the rest. Both outer loops end by one
   * criterion: the residual of the fully regenerated problem (new stations,
   * normals, friction limits, stiffnesses) is below the contact tolerance
   * times the largest contact force.
   */
  class Equilibrium
  {
  public:
    using Progress = Newton::Progress;
    using Watch    = Newton::Watch;

    /**
     * References are kept. @p watch is called before each Newton iteration
     * and may throw.
     */
    Equilibrium(const FiberMesh  &mesh,
                const Parameters &parameters,
                ContactGenerator &generator,
                System           &system,
                StageStatistics  &statistics,
                Watch             watch);

    using Problem = fiberloom::Problem;

    /**
     * Moves @p state , which is the last accepted one, to equilibrium by the
     * nested loops or, where they do not contract, by solve_in_one_loop().
     * False, with @p state spoilt, if neither does it, or if fibers may have
     * passed through each other on the way.
     */
    bool
    solve(State &state, const Problem &problem);

    /**
     * As solve(), but contacts and normals are generated anew in every Newton
     * iteration, whose tangent gets a diagonal of @p damping over E r: the
     * frozen normals of a tangent hide that slender fibers in a tow are
     * unstable sideways, and without it they are thrown far. Near balance it
     * may take four times @p largest_iterations where the problem has no load
     * step.
     */
    bool
    solve_in_one_loop(State             &state,
                      const Problem     &problem,
                      const unsigned int largest_iterations,
                      const double       damping);

    /**
     * From @p state , whose contacts have been generated, by Newton's method;
     * zones in which fibers are too deep are stiffened in between.
     */
    bool
    solve_by_newton(State &state, const Problem &problem);

    /** Over E r, to be tried one after the other. */
    std::array<double, 2>
    dampings() const;

    /** @p n iterations of that loop, converged or not. */
    void
    iterate(State             &state,
            const Problem     &problem,
            const unsigned int n,
            const double       damping);

    /** Contacts of the last solve. */
    const std::vector<ContactElement> &
    contacts() const
    {
      return increment.contacts;
    }

    double
    largest_penetration() const // over the radius
    {
      return penetration.largest(increment.contacts);
    }

    /** Of the last tangent that was factorised, before it was shifted; -1 if
     * that failed. */
    int
    negative_pivots() const
    {
      return last_negative_pivots;
    }

    /** Whether the last increment came to rest with a folded element. */
    bool
    ends_folded() const
    {
      return folded;
    }

    /** Whether that was why the last increment was not accepted. */
    bool
    ends_passed() const
    {
      return passed;
    }

  private:
    /** As solve(), whatever the fibers may have passed. */
    bool
    find(State &state, const Problem &problem);

    bool
    newton(State &state, const Problem &problem, const double tolerance);

    enum class Step
    {
      converged,
      moved,
      failed
    };

    Step
    newton_step(State         &state,
                const Problem &problem,
                const double   tolerance,
                const bool     search_line);

    double
    search_along(const State           &state,
                 const Problem         &problem,
                 const Eigen::VectorXd &step,
                 const double           factor) const;

    enum class Outcome
    {
      converged,
      slow, // towards equilibrium, but not fast enough
      failed
    };

    /** Whether fibers touch at @p state , and what is asked has a potential. */
    bool
    uses_newton(const State &state, const Problem &problem) const;

    /** Whether normals follow every iteration from the first one on. */
    bool
    follows(const Problem &problem) const;

    /** The last accepted state with its contacts, of a fabric whose ends move
     * stiffened where the increment would have to. */
    void
    begin(State &state, const Problem &problem);

    /**
     * Contacts of @p state , and where the last increment, or else an even
     * deformation, tells where fibers go, those of the extrapolated state,
     * unless that throws fibers deep into each other. False where an even
     * deformation does so: a shorter increment's will not.
     */
    bool
    extrapolate(State &state, const Problem &problem);

    /** From contacts that have been generated. */
    Outcome
    solve_nested(State &state, const Problem &problem);

    /** The tightest that Newton's method is asked for in an outer loop. */
    double
    tightest() const;

    const FiberMesh  &mesh;
    const Parameters &parameters;
    ContactGenerator &generator;
    System           &system;
    LinearSolver      linear_solver;
    StageStatistics  &statistics;
    Watch             watch;
    Increment         increment;
    Damping           damping;
    Newton            by_newton;
    Penetration       penetration;
    double            last_factor   = 1; // of a Newton step
    double            last_residual = 0; // before it
    double            longest_step  = 1;
    bool              in_one_loop   = false;
    bool              pulls         = false; // in that loop

    // Of steps that move bodies, over the radius.
    double prescribed_limit;

    double last_cut             = 1; // by the last line search
    int    last_negative_pivots = 0;
    bool   folded               = false;
    bool   passed               = false;

    unsigned int n_yardsticks = 0; // whose mean is in the statistics
  };
} // namespace fiberloom

#endif
