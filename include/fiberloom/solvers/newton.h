// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_solvers_newton_h
#define fiberloom_solvers_newton_h

#include <fiberloom/solvers/fiber_bounds.h>
#include <fiberloom/solvers/increment.h>
#include <fiberloom/solvers/linear_solver.h>
#include <fiberloom/solvers/moving_fibers.h>
#include <fiberloom/solvers/penetration.h>

#include <functional>
#include <memory>
#include <vector>

namespace fiberloom
{
  /**
   * Newton's method on the incremental potential of fibers, contacts whose
   * points follow them, friction with limits of an earlier iterate, matrix and
   * loads. Steps are judged by energy; section 4.4 of the theory has the
   * algorithm.
   *
   * Soft fibers slide along a curved valley between stiff ones. A step along
   * it is followed by corrections with the factor at hand, which lead back to
   * its floor, and contacts that a step would close take part in it. Where the
   * Hessian is indefinite, that of contacts loses what makes it so, without
   * friction that of fibers, too, and no fiber goes further than its own bound;
   * where few still move, these come to rest by themselves.
   * Where they are new, friction's limits follow the normal forces within the
   * linear system, as long as the residual gets smaller, and it or the step
   * that is left much smaller.
   */
  class Newton
  {
  public:
    /** Where the method is. */
    struct Progress
    {
      double residual; // over its scale
      double damping;  // over E r
      double factor;   // of the step that led here
    };

    using Watch = std::function<void(const Progress &)>;

    /**
     * References are kept. @p largest_move : how far fibers may go in one step,
     * over their radius; 0: unlimited. @p watch is called before each iteration
     * and may throw.
     */
    Newton(Increment    &increment,
           LinearSolver &linear_solver,
           const double  largest_move,
           Watch         watch);

    /**
     * Moves @p state , in which prescribed dofs are at their targets and
     * contacts have been generated, to equilibrium: everything generated
     * anew, the residual is below the tolerance of the increment. False, with
     * @p state spoilt, where @p most iterations do not lead there.
     * @p penetration stiffens zones that are too deep, as soon as forces are
     * about right; without it they stay as they are.
     */
    bool
    solve(State             &state,
          const Problem     &problem,
          const unsigned int most,
          const Penetration *penetration = nullptr);

    /**
     * Number of negative pivots of the last exact tangent of all fibers; -1 if
     * its factorisation failed.
     */
    int
    negative_pivots() const
    {
      return last_negative_pivots;
    }

  private:
    // Stations are found anew when a fiber has moved by this, over its radius:
    // a third of what the search sees beyond the surfaces.
    static constexpr double stale_after = .1;

    // Predictions in one iteration of contacts whose stiffness changes.
    static constexpr unsigned int most_predictions = 2;

    // Corrections around one factor where the energy judges.
    static constexpr unsigned int most_corrections = 3;

    // From one trial to the next neither the length of a step nor Levenberg's
    // diagonal changes by more than this; a cut is at least by half.
    static constexpr double largest_change = 10, shortest = 1 / largest_change,
                            longest_cut = .5;

    // Where fibers may buckle, an energy that falls by more than this part
    // beyond what was promised does not have a minimum nearby.
    static constexpr double trusted_error = longest_cut;

    // A model is poor where less than this part of what it promises comes true,
    // and good where at most this part is missing.
    static constexpr double poor_model = .25, good_model = 1 - poor_model;

    // Levenberg's least diagonal, over E r.
    static constexpr double least_damping = 1e-5;

    // Linear systems are solved to the first of these tolerances close to rest,
    // and to the second where a better step hardly ever pays: far from rest,
    // and with limits that follow.
    static constexpr double linear_tolerance = 1e-6, rough_tolerance = 1e-2;

    /** A step in all dofs. */
    struct Step
    {
      std::vector<double> solution; // of the linear system
      Eigen::VectorXd     increment;
      std::vector<double> response;  // of the system's matrix
      double              slope = 0; // of the energy along it [N mm]
      double              move  = 0; // largest, over the radius
    };

    /** Where a line search ends. */
    struct Reached
    {
      State        state;
      double       energy = 0; // [N mm]
      double       factor = 1; // of the step
      unsigned int cuts   = 0;
    };

    /** Where a step leads whose friction limits follow. */
    struct CoupledStep
    {
      State  state;
      double residual = 0; // everything generated anew, over its scale
      Step   next;         // by the same matrix
    };

    /** The residual over its scale below which the method ends. */
    double
    tolerance(const Problem &problem) const;

    /**
     * Whether the residual is below the tolerance, or the state as near to
     * balance as the problem asks.
     */
    bool
    is_balanced(const Problem &problem) const;

    /**
     * Whether forces are right enough to stiffen zones in which fibers are too
     * deep.
     */
    bool
    depths_are_known(const Problem &problem) const;

    /**
     * Forgets all that was learnt of earlier states, so that the method starts
     * anew from the present one.
     */
    void
    begin();

    /** Sets the residual to that of the system that was assembled last. */
    void
    measure(const Problem &problem);

    /**
     * Brings contacts up to date with @p state . The first ones keep limits and
     * planes of friction of those that were there.
     */
    void
    refresh(State &state, const Problem &problem);

    /** Whether the residual has halved since limits of friction were set, so
     * that there may be new ones. */
    bool
    has_halved(const State &state, const Problem &problem);

    /** Whether the Hessian may be definite: the last step did not tell
     * otherwise, nor did a Hessian of all fibers shortly before, and a weave's
     * forces are about right. */
    bool
    is_exact_worth_it(const Problem &problem) const;

    /**
     * Measures the residual of all fibers. The few that moved last move again
     * if they are still what is out of balance; else all do.
     */
    void
    go_on_with_few(const State &state, const Problem &problem);

    /**
     * Generates everything anew at @p state ; whether that is in balance. If
     * not, it is assembled for the next iteration.
     */
    bool
    is_at_rest(State &state, const Problem &problem);

    /**
     * Assembles residual and tangent at @p state , the tangent of fibers and of
     * contacts whose points follow them with this @p curvature .
     */
    void
    assemble(const State    &state,
             const Problem  &problem,
             const Curvature curvature);

    /**
     * Restricts matrix and gradient that were assembled to the fibers that move
     * in this iteration.
     */
    void
    restrict_to_moving();

    /**
     * Corrects @p step by the contacts that it closes, which get a part in the
     * matrix; false where it is not finite.
     */
    bool
    predict(const State &state, const Problem &problem, Step &step);

    /** Holds fibers that @p step moves too far: by their own bounds, which are
     * added to the matrix, or by what is returned, which the next solution is
     * to add to the whole diagonal, over E r. */
    double
    hold(const Step &step);

    /**
     * Solves for the first @p step of an iteration by the tangent as it is or,
     * where that is indefinite, by one that is nearly definite.
     */
    void
    solve_first(const State &state, const Problem &problem, Step &step);

    /**
     * Tolerance of the next linear system, well below the residual that its
     * step will leave.
     */
    double
    forcing() const;

    /** Sets all that follows from the solution in @p step . */
    void
    complete(Step &step) const;

    /**
     * By how much the energy falls on the part @p factor of @p step [N mm] if
     * it is a parabola whose lowest point is where @p step ends.
     */
    static double
    promise(const Step &step, const double factor = 1);

    /** @p step , cut at the bounds of fibers if there are any. */
    Step
    bounded(const Step &step) const;

    /** The solver for the fibers that move in this iteration. */
    LinearSolver &
    solver()
    {
      return moving.are_all() ? linear_solver : *of_few;
    }

    /** Scalar product of two vectors by owned dofs, summed over all ranks. */
    double
    dot(const std::vector<double> &a, const std::vector<double> &b) const;

    /**
     * Solves the system that was assembled last, with @p damping (over E r)
     * added to its diagonal, for @p step . False where it is indefinite and
     * that is to be refused.
     */
    bool
    solve_linear(const State                   &state,
                 const double                   damping,
                 const LinearSolver::Indefinite indefinite,
                 Step                          &step);

    /**
     * Finds a @p step in which friction limits follow the normal forces;
     * whether there is one.
     */
    bool
    find_coupled_step(const State &state, const Problem &problem, Step &step);

    /**
     * Takes a step in which friction limits follow the normal forces, if the
     * regenerated problem is then nearer to balance; whether it has.
     */
    bool
    take_coupled_step(State &state, const Problem &problem);

    /**
     * Moves @p there , with the residual that it has, by @p factor times
     * @p step . Whether its residual or its next step is then smaller, or no
     * step is needed.
     */
    bool
    reach_coupled(CoupledStep   &there,
                  const Problem &problem,
                  const Step    &step,
                  const double   factor);

    /** Goes on by next steps as long as that leads nearer to balance. */
    void
    correct_coupled(CoupledStep &there, const Problem &problem);

    /**
     * Solves for @p step by the matrix in which friction limits follow the
     * normal forces; whether there is a solution.
     */
    bool
    solve_coupled(const std::vector<double> &right_hand_side, Step &step);

    /**
     * Moves @p state along the part of @p step on which prescribed nodes move
     * as far as allowed.
     */
    void
    follow_motion(State &state, const Problem &problem, const Step &step);

    /**
     * The state that @p factor times @p step leads to from @p state , and its
     * energy.
     */
    Reached
    at(const State   &state,
       const Problem &problem,
       const Step    &step,
       const double   factor) const;

    /** Shortens @p step until it leads to an energy below @p here [N mm]. */
    Reached
    search(const State   &state,
           const Problem &problem,
           const Step    &step,
           const double   here);

    /**
     * Moves @p state down the energy along @p step and back to the valley's
     * floor.
     */
    void
    descend(State &state, const Problem &problem, const Step &step);

    /**
     * Chooses the fibers that move in the next iteration: those that went
     * furthest on the last one's @p way of all fibers.
     */
    void
    choose_moving(const DofVector &way);

    /**
     * What is out of balance at @p there of the fibers that move [N], by owned
     * dofs.
     */
    std::vector<double>
    residual_at(const State &there, const Problem &problem);

    /** Adds corrections to what @p step reached as long as they lower the
     * energy or, where that tells nothing, what is out of balance. */
    void
    correct(const State   &state,
            const Problem &problem,
            const Step    &step,
            Reached       &there);

    /**
     * Goes twice as far along @p step , with corrections, as long as the energy
     * falls as if it had no minimum.
     */
    void
    lengthen(const State   &state,
             const Problem &problem,
             const Step    &step,
             const double   here,
             Reached       &found);

    /** @p state moved by @p factor times @p increment . */
    State
    moved(const State           &state,
          const Eigen::VectorXd &increment,
          const double           factor) const;

    /**
     * Potential @p at a state less the work of dead loads since @p from [N mm].
     */
    double
    energy(const State &from, const State &at, const Problem &problem) const;

    /**
     * The largest part of @p step , at most 1, that does not move fibers too
     * far.
     */
    double
    longest(const Step &step) const;

    const FiberMesh &mesh;
    System          &system;
    LinearSolver    &linear_solver;
    StageStatistics &statistics;
    Increment       &increment;
    const double     largest_move;
    Watch            watch;

    DofVector           generated_at;
    std::vector<double> gradient; // with the sign of a right hand side
    Step                other;    // without contacts that are to close
    FiberBounds         bounds;
    MovingFibers        moving;                // in this iteration
    std::unique_ptr<LinearSolver> of_few;      // of these, once there are few
    bool         is_bounded           = false; // fibers, in this iteration
    bool         is_exact             = true;  // the tangent of this iteration
    bool         trusted              = true;  // the model of the last one
    double       exact_below          = 1e300; // this residual it may be exact
    bool         is_near_enough       = false; // as Problem asks
    bool         ends_exactly         = false; // the step before, or it cannot
    double       damping              = 0;     // over E r
    double       residual             = 0;     // over its scale
    double       lagged               = 0; // that, when limits were last set
    bool         limits_are_new       = false; // of friction, at this state
    double       coupled_below        = 0; // this residual limits may follow
    double       coupled_since        = 0; // this one they do; 0: they lag
    double       last_factor          = 1;
    unsigned int last_krylov          = 0;     // iterations, with such limits
    bool         factor_is_behind     = false; // the matrix
    int          last_negative_pivots = 0;
  };
} // namespace fiberloom

#endif
