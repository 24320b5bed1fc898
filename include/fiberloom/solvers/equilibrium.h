// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_solvers_equilibrium_h
#define fiberloom_solvers_equilibrium_h

#include <fiberloom/base/statistics.h>

#include <fiberloom/contact/contact_generator.h>

#include <fiberloom/model/system.h>

#include <fiberloom/solvers/increment.h>
#include <fiberloom/solvers/linear_solver.h>
#include <fiberloom/solvers/newton.h>
#include <fiberloom/solvers/penetration.h>

#include <vector>

namespace fiberloom
{
  struct Parameters;

  /**
   * Finds the equilibrium of an increment by Newton's method on the potential
   * of what touches, or by the three nested loops of section 3.6 of the paper:
   * on contact generation, on contact normals with friction limits, and
   * Newton's method on all the rest. Either ends by one criterion: the residual
   * of the fully regenerated problem (new stations, normals, friction limits)
   * is below the contact tolerance times the largest contact force.
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
    Equilibrium(const Parameters &parameters,
                ContactGenerator &generator,
                System           &system,
                StageStatistics  &statistics,
                Watch             watch);

    using Problem = fiberloom::Problem;

    /**
     * Moves @p state , which is the last accepted one, to equilibrium: by
     * Newton's method, or by the nested loops where they are asked for, while
     * fibers are woven from above, and where loads have no potential. False,
     * with @p state spoilt, if that fails, or if fibers may have passed through
     * each other on the way.
     */
    bool
    solve(State &state, const Problem &problem);

    /** Finds contacts and reactions of @p state as it is. */
    void
    evaluate(State &state, const Problem &problem);

    /**
     * Does what solve() does from @p state , which was in balance before its
     * fibers were broken.
     */
    bool
    solve_again(State &state, const Problem &problem);

    /**
     * Moves @p state , whose contacts have been generated, to equilibrium by
     * Newton's method; zones in which fibers are too deep are stiffened in
     * between. False, with @p state spoilt, if that fails.
     */
    bool
    solve_by_newton(State &state, const Problem &problem);

    /**
     * Generates the contacts of @p state as it is, and then does what
     * solve_by_newton() does.
     */
    bool
    solve_from(State &state, const Problem &problem);

    /**
     * Does at most @p n iterations of Newton's method, or all that it takes
     * where nothing touches; whether they lead to balance. Where contact is
     * @p stiffer than when @p state was found, friction begins with limits by
     * the forces of then.
     */
    bool
    approach(State             &state,
             const Problem     &problem,
             const unsigned int n,
             const double       stiffer = 1);

    /**
     * Does @p n iterations, converged or not, before each of which contacts are
     * generated anew; the tangent gets a diagonal of @p damping over E r, as
     * frozen normals hide that slender fibers are unstable sideways.
     */
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

    /**
     * The largest penetration of contacts of the last solve, over the radius.
     */
    double
    largest_penetration() const // over the radius
    {
      return penetration.largest(increment.contacts);
    }

    /**
     * Number of negative pivots of the last tangent that was factorised, before
     * it was shifted; -1 if its factorisation failed.
     */
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
    /** Does what solve() does, whatever the fibers may have passed. */
    bool
    find(State &state, const Problem &problem);

    /**
     * Whether no fiber may have passed through another on the way to @p state ;
     * remembers the answer.
     */
    bool
    keeps_sides(const State &state, const Problem &problem);

    /** @p problem with contact points that follow the fibers. */
    static Problem
    following(const Problem &problem);

    /** Whether the nested loops solve it. */
    bool
    is_nested(const Problem &problem) const;

    /**
     * Moves @p state to equilibrium, whose contacts have been generated for the
     * loops that solve it.
     */
    bool
    solve_from_contacts(State &state, const Problem &problem);

    bool
    newton(State &state, const Problem &problem);

    enum class Step
    {
      converged,
      moved,
      failed
    };

    /** How far a Newton step goes, where nothing else shortens it. */
    enum class StepLength
    {
      whole,
      by_energy
    };

    Step
    newton_step(State           &state,
                const Problem   &problem,
                const double     damping,
                const StepLength length);

    double
    search_along(const State           &state,
                 const Problem         &problem,
                 const Eigen::VectorXd &step,
                 const double           factor) const;

    /** Whether a fabric is pulled, pressed or bent, not woven. */
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

    /**
     * Moves @p state to equilibrium by the nested loops; its contacts have been
     * generated.
     */
    bool
    solve_nested(State &state, const Problem &problem);

    /** Times a factorisation of the last tangent, for a benchmark. */
    void
    time_yardstick();

    const FiberMesh  &mesh;
    const Parameters &parameters;
    ContactGenerator &generator;
    System           &system;
    LinearSolver      linear_solver;
    StageStatistics  &statistics;
    Watch             watch;
    Increment         increment;
    Newton            by_newton;
    Penetration       penetration;
    double            last_factor          = 1; // of a Newton step
    int               last_negative_pivots = 0;
    bool              folded               = false;
    bool              passed               = false;
    unsigned int      n_yardsticks = 0; // whose mean is in the statistics
  };
} // namespace fiberloom

#endif
