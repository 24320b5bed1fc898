// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_simulation_stage_run_h
#define fiberloom_simulation_stage_run_h

#include <fiberloom/base/log.h>
#include <fiberloom/base/parameters.h>

#include <fiberloom/beams/breakage.h>

#include <fiberloom/stages/stage.h>

#include <functional>
#include <memory>
#include <string>

namespace fiberloom
{
  /** What a stage is run with, besides its scene. */
  struct RunContext
  {
    ContactGenerator     &generator;
    Log                  &log;
    const MPI_Comm        comm;
    std::function<bool()> stop_requested; // asked before each Newton iteration
  };

  /**
   * Takes a stage from its start, or from where @p state is, to its end by
   * increments of the load. A failed increment is rolled back, cut and tried
   * again; a cheap one lets the next be longer.
   */
  class StageRun
  {
  public:
    /**
     * Prepares the run of @p stage . @p statistics are those of the stage, to
     * which the run adds; @p state is where it will begin or go on. References
     * are kept.
     */
    StageRun(const Scene      &scene,
             const Stage      &stage,
             const RunContext &context,
             StageStatistics  &statistics,
             const State      &state);

    /**
     * A function that is called with the states before and after an increment,
     * to estimate what is known of its error.
     */
    using Estimate =
      std::function<void(const State &before, const State &reached)>;

    /**
     * A function that is called with the state a run can go on from before its
     * first increment.
     */
    using Keep = std::function<void(const State &)>;

    /** What is to come after this stage, for the log. */
    struct Ahead
    {
      unsigned int increments = 0; // of tests, if none fails
      double       seconds    = 0; // of one, by the stages before; 0: unknown
    };

    /**
     * @p observer sees each accepted state, @p keep the one that coarser meshes
     * lead to. Where the way of a test is farthest
     * from its start and goes on, @p estimate is called, if there is one, with
     * the increment that leads there. Throws StageFailure when even the
     * smallest increment fails and StopRequested on request, with the last
     * accepted state in @p state .
     */
    void
    run(State                   &state,
        const IncrementObserver &observer,
        const Estimate          &estimate = {},
        const Keep              &keep     = {},
        const Ahead             &ahead    = {0, 0});

    /** Seconds that an increment of a test takes, as far as is known. */
    double
    seconds_of_increment() const;

    /**
     * Takes @p state from the start to the end of the stage by the stage's fast
     * path alone. False, with @p state as it was, where that does not lead
     * there. Throws StopRequested on request.
     */
    bool
    run_fast(State &state);

    /** The state from which the last increment of the stage started; empty if
     * there was none. */
    const State &
    before_last() const
    {
      return last_start;
    }

  private:
    /** Where an increment begins. */
    struct Before
    {
      State           state;
      StageStatistics statistics;
    };

    /** @p state at the start of the stage. */
    State
    begun(const State &state) const;

    /**
     * Runs the start of the stage on coarser meshes, where that is allowed, and
     * stores in @p state where it can go on from; whether there is such a
     * place.
     */
    bool
    start_on_coarser_meshes(State &state);

    bool
    take_fast_path(State &state);

    void
    take_increment(State &state);

    /**
     * Ends the increment that has led from @p before to @p state : calls @p
     * estimate where it is the farthest point of a way that turns, and shows
     * the increment to @p observer . Where that throws, @p state and
     * statistics are set back to what they were.
     */
    void
    end_increment(State                   &state,
                  const Before            &before,
                  const Estimate          &estimate,
                  const IncrementObserver &observer);

    /** Lets a way that ends a leg at @p state go on as from its start, and
     * keeps the energies there. */
    void
    turn(State &state);

    /** The test's first row: @p state , where it begins. */
    void
    show_start(State &state, const IncrementObserver &observer);

    /**
     * Breaks what does not hold in @p found , which is in balance at @p load ,
     * and finds balance again until all holds. False, with @p found spoilt,
     * where there is none.
     */
    bool
    break_fibers(State                      &found,
                 const Equilibrium::Problem &problem,
                 const double                load);

    /**
     * Names, for the message, the place where the increment that failed is
     * farthest from balance at @p state .
     */
    std::string
    unbalanced(const State &state) const;

    /** What may help where increments fail, for the message. */
    std::string
    advice() const;

    /** The same where fibers would have passed through each other in one. */
    static std::string
    advice_on_passage();

    void
    accept(State &state, State &&found, const double load);

    void
    show(const State &state, const IncrementObserver &observer);

    /** Hands @p state and its row of the curve to @p observer . */
    void
    report(const State &state, const IncrementObserver &observer) const;

    /** Sum of the normal forces between different tows of one family [N]. */
    double
    force_of_neighbors() const;

    CurveRow
    contact_forces() const;

    std::string
    increment_line(const State &state) const;

    /** Seconds of computing in this stage so far. */
    double
    seconds_of_stage() const;

    std::string
    iteration_line(const Equilibrium::Progress &progress) const;

    const Scene                           scene;
    const Stage                          &stage;
    const std::string                     name;
    const RunContext                      context;
    StageStatistics                      &statistics;
    const std::unique_ptr<const Breakage> breakage; // null: nothing breaks
    const Supports                        supports;
    System                                system;
    Equilibrium                           equilibrium;
    StageStatistics shown;            // what the last line of the log has told
    unsigned int    counted_searches; // are in the statistics
    State           last_start;
    Ahead           ahead;
  };
} // namespace fiberloom

#endif
