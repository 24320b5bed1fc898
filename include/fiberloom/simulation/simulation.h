// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_simulation_simulation_h
#define fiberloom_simulation_simulation_h

#include <fiberloom/base/command_line.h>
#include <fiberloom/base/log.h>
#include <fiberloom/base/parameters.h>
#include <fiberloom/base/stop_request.h>

#include <fiberloom/contact/contact_generator.h>

#include <fiberloom/stages/stage.h>

#include <fiberloom/output/directory_lock.h>
#include <fiberloom/output/writer.h>

#include <fiberloom/simulation/stage_run.h>

#include <chrono>
#include <functional>
#include <memory>
#include <optional>

namespace fiberloom
{
  /** A whole run: parameters to model to stages to output. */
  class Simulation
  {
  public:
    /** Builds the model, in an output directory that is there locked from the
     * first. Throws InputError. */
    Simulation(const Parameters  &parameters,
               const CommandLine &command_line,
               const MPI_Comm     comm);

    /** Returns the exit status. Throws InputError before anything is written.
     */
    int
    run();

  private:
    ModelSize
    model_size() const;

    /** Size of the model with the matrix that the scene asks for. */
    ModelSize
    expected_size() const;

    /**
     * Memory that the run is expected to need on all ranks together [bytes].
     */
    double
    expected_memory() const;

    void
    print_check();

    /** Throws StageFailure where the model will not fit into what is there, and
     * takes what libraries need for themselves. Collective. */
    void
    check_memory() const;

    /**
     * The state to start from. Where the scene's stages begin with those that
     * the checkpoint has behind it, or are those of the run that wrote it, the
     * run goes on after them, inside the next one if that is under way. Any
     * other list of stages starts from the state as from scratch. Sets
     * #continues . Throws InputError.
     */
    State
    initial_state();

    /**
     * Number of the stage in which the run of the restart file is to go on, as
     * many as there are if none is left; nothing if the scene's stages do not
     * continue that run.
     */
    std::optional<unsigned int>
    next_stage() const;

    /** Whether the restart file lies in the output directory. Collective. */
    bool
    restarts_in_place() const;

    /** Throws InputError where the run would replace what it starts from, or
     * the checkpoint of another. Collective. */
    void
    check_restart_file() const;

    /**
     * What the scene asks for and the run that wrote the restart file did not:
     * notes for the log. Throws InputError if @p state leaves no stage to do
     * it.
     */
    std::vector<std::string>
    compare_with_restarted(const State &state) const;

    /** Opens log and files, and writes what they say of the run so far. */
    void
    begin_output(OutputWriter &writer, const State &state);

    /** Gives @p writer the statistics of what the restarted run did before. */
    void
    record_stages_before(const State &state, OutputWriter &writer) const;

    /** Statistics of the stage that @p state is in. */
    StageStatistics
    statistics_so_far(const State &state) const;

    /**
     * Runs the stages from that of @p state on; returns the exit status. Once
     * stages have been run, input that the next one does not allow is a
     * StageFailure, and what has been reached is kept.
     */
    int
    run_stages(State &state, OutputWriter &writer, StopRequest &stop);

    /**
     * Runs one stage and estimates its error; @p before_last is the state
     * before the last increment, once all are done.
     */
    void
    run_stage(State           &state,
              OutputWriter    &writer,
              StopRequest     &stop,
              StageStatistics &statistics,
              State           &before_last);

    /**
     * Writes checkpoint, summary and a line in the log; returns the exit
     * status.
     */
    int
    end_on_request(OutputWriter                &writer,
                   const StopRequest           &stop,
                   const std::function<void()> &save);

    /** What is to come after the stage that @p state is in. */
    StageRun::Ahead
    ahead(const Scene &scene, const State &state) const;

    /**
     * Estimates the error of a stage that has come from @p before by its last
     * increment, for log.txt and @p statistics .
     */
    void
    estimate(const Scene     &scene,
             const State     &before,
             const State     &reached,
             StageStatistics &statistics,
             StopRequest     &stop);

    /** The matrix of @p state , which stage @p stage gives it if it is to; null
     * if there is none. */
    std::unique_ptr<Composite>
    make_composite(const std::string &stage, State &state);

    /**
     * Notes of all stages, each of which is created, as its checks of the input
     * come with that.
     */
    std::vector<std::string>
    stage_notes(const State &state) const;

    void
    log_header();

    void
    log_what_is_left_out();

    void
    log_timings(const std::vector<StageStatistics> &stages);

    void
    log_benchmark(const std::vector<StageStatistics> &stages);

    /** Writes to the log where the results are. */
    void
    log_results();

    const std::chrono::steady_clock::time_point start =
      std::chrono::steady_clock::now();
    const Parameters               parameters;
    const CommandLine              command_line;
    const MPI_Comm                 comm;
    std::unique_ptr<DirectoryLock> lock;
    const FiberSet                 fibers;
    const FiberMesh                mesh;
    ContactGenerator               generator;
    Log                            log;
    Checkpoint                     restart;
    bool   continues            = false; // the files in the output directory
    double seconds_of_increment = 0;     // of a test; 0: not known yet
  };
} // namespace fiberloom

#endif
