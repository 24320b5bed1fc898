// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/memory.h>
#include <fiberloom/base/scoped_timer.h>

#include <fiberloom/fabric/input_notes.h>

#include <fiberloom/stages/coat.h>

#include <fiberloom/output/checkpoint_checks.h>

#include <fiberloom/simulation/error_estimate.h>
#include <fiberloom/simulation/simulation.h>
#include <fiberloom/simulation/stage_run.h>

#include <deal.II/base/mpi.h>

#include <boost/format.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <sstream>

namespace fiberloom
{
  namespace
  {
    /** The first of @p changes , and how many more there are. */
    std::string
    summarized(const std::vector<std::string> &changes)
    {
      const auto more = changes.size() - 1;
      return changes.front() +
             (more > 0 ? ", and " + std::to_string(more) + " more" : "");
    }

    /** Throws InputError where plates would have to press on a matrix. */
    void
    check_compaction(const Parameters &parameters, const State &state)
    {
      const std::string coat       = stage_names(&StageType::adds_matrix);
      bool              has_matrix = !state.matrix.is_empty();
      for (unsigned int s = state.stage; s < parameters.stages.size(); ++s)
        {
          const StageType &type = stage_type(parameters.stages[s]);
          has_matrix            = has_matrix || type.adds_matrix;
          if (type.needs_no_matrix && has_matrix)
            throw InputError(parameters.where("Stages") + ": " + type.name +
                             " presses dry fabrics, and " + coat +
                             " has made a matrix; allowed: " + type.name +
                             " before " + coat);
        }
    }

    /** Null where there is no directory to be locked yet. */
    std::unique_ptr<DirectoryLock>
    lock_if_there(const std::string &directory, const MPI_Comm comm)
    {
      using namespace dealii::Utilities::MPI;
      std::error_code ignored;
      if (broadcast(comm,
                    this_mpi_process(comm) == 0 &&
                      std::filesystem::is_directory(directory, ignored),
                    0))
        return std::make_unique<DirectoryLock>(directory, comm);
      return nullptr;
    }
  } // namespace



  Simulation::Simulation(const Parameters  &parameters,
                         const CommandLine &command_line,
                         const MPI_Comm     comm)
    : parameters(parameters)
    , command_line(command_line)
    , comm(comm)
    , lock(command_line.check ?
             nullptr :
             lock_if_there(parameters.output_directory, comm))
    , fibers(build_fiber_set(parameters))
    , mesh(fibers)
    , generator(fibers, mesh, parameters.contact, comm)
    , log(comm)
  {}



  ModelSize
  Simulation::model_size() const
  {
    ModelSize size;
    size.fibers         = mesh.lines().size();
    size.nodes          = mesh.n_nodes();
    size.fiber_elements = mesh.n_elements();
    size.fiber_dofs     = mesh.reference().size();
    return size;
  }



  ModelSize
  Simulation::expected_size() const
  {
    ModelSize size   = model_size();
    size.matrix_dofs = 3 * n_layer_nodes(matrix_of(parameters));
    return size;
  }



  double
  Simulation::expected_memory() const
  {
    const ModelSize    size  = expected_size();
    const unsigned int ranks = dealii::Utilities::MPI::n_mpi_processes(comm);
    // Fitted to woven samples of 6,300 to 55,188 dofs, doc/performance.md; the
    // exponent is that of a nested dissection factor.
    const double factor =
      .42 * std::pow((size.fiber_dofs + size.matrix_dofs) / 55188., 1.13);
    const bool whole =
      parameters.solver.linear_solver == Preconditioning::double_factor;
    return gibibyte * (.17 * ranks + (whole ? 1.5 : 1) * factor);
  }



  void
  Simulation::print_check()
  {
    const ModelSize size      = expected_size();
    double          available = 0;
    const bool      fits = fits_into_memory(expected_memory(), comm, available);
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      std::cout << "fibers          " << size.fibers << "\nnodes           "
                << size.nodes << "\nfiber dofs      " << size.fiber_dofs
                << "\nfiber elements  " << size.fiber_elements
                << "\nmatrix dofs     " << size.matrix_dofs
                << "\nplies           " << fibers.n_plies()
                << "\nexpected memory "
                << boost::format("%.1f GiB") % (expected_memory() / gibibyte)
                << "\navailable memory "
                << boost::format("%.1f GiB") % (available / gibibyte)
                << (fits ? "" : ", too little") << std::endl;
  }



  void
  Simulation::check_memory() const
  {
    double available = 0;
    if (!fits_into_memory(expected_memory(), comm, available))
      throw StageFailure(
        (boost::format("too little memory: the model needs some %.2f GiB, and "
                       "%.2f GiB are there; a smaller model, fewer ranks or "
                       "another computer may help") %
         (expected_memory() / gibibyte) % (available / gibibyte))
          .str());
    reserve_blas_buffers();
  }



  State
  Simulation::initial_state()
  {
    State state;
    state.q = mesh.initial();
    if (command_line.restart.empty())
      return state;

    restart =
      read_checkpoint(command_line.restart, describe_model(fibers, mesh), comm);
    try
      {
        check_checkpoint(restart, mesh);
      }
    catch (const InputError &error)
      {
        throw InputError(command_line.restart + ": this checkpoint " +
                         error.what());
      }
    const State &before = restart.state;
    const auto  &stages = parameters.stages;
    const auto   next   = next_stage();
    parameters.check_stage_order(before.stages_done, next.value_or(0));
    check_matrix(parameters, before.matrix);
    state = before;
    if (!next)
      state.begin_stage(0);
    else if (*next == stages.size() || stages[*next] != before.stage_name())
      state.begin_stage(*next);
    else
      state.stage = *next; // under way
    continues = next == before.stage && restarts_in_place();
    check_restart_file();
    return state;
  }



  std::optional<unsigned int>
  Simulation::next_stage() const
  {
    const State &before = restart.state;
    const auto  &done   = before.stages_done;
    const auto  &stages = parameters.stages;
    if (done.size() <= stages.size() &&
        std::equal(done.begin(), done.end(), stages.begin()))
      return done.size();
    // A run that itself had started from another's state.
    if (before.scene_stages == stages)
      return before.stage;
    return {};
  }



  bool
  Simulation::restarts_in_place() const
  {
    namespace fs  = std::filesystem;
    bool in_place = false;
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      {
        std::error_code error;
        in_place =
          fs::equivalent(fs::absolute(command_line.restart).parent_path(),
                         parameters.output_directory,
                         error);
      }
    return dealii::Utilities::MPI::broadcast(comm, in_place, 0);
  }



  void
  Simulation::check_restart_file() const
  {
    namespace fs = std::filesystem;
    using namespace dealii::Utilities::MPI;

    const fs::path directory = parameters.output_directory;
    bool           replaced  = false;
    if (restarts_in_place() && this_mpi_process(comm) == 0)
      {
        std::error_code error;
        const auto      is = [&](const char *name) {
          return fs::equivalent(command_line.restart, directory / name, error);
        };
        replaced = fs::exists(directory / "checkpoint", error) &&
                   !is("checkpoint") && (continues || is("checkpoint.before"));
      }
    if (broadcast(comm, replaced, 0))
      throw InputError(command_line.restart + ": the run would replace " +
                       (directory / "checkpoint").string() +
                       ", which is another; rename one of them, or give "
                       "another --output-directory");
  }



  std::vector<std::string>
  Simulation::compare_with_restarted(const State &state) const
  {
    if (command_line.restart.empty() || !next_stage())
      return {};
    std::ostringstream asked;
    parameters.print(asked);
    auto changes = changed_entries(restart.run.asked, asked.str());
    // Without a matrix only an exported deck knows of its section.
    if (!parameters.has_matrix() && restart.state.matrix.is_empty())
      changes.erase(std::remove_if(changes.begin(),
                                   changes.end(),
                                   [](const std::string &change) {
                                     return change.rfind("Matrix/", 0) == 0;
                                   }),
                    changes.end());
    if (changes.empty())
      return {};
    if (state.stage == parameters.stages.size())
      throw InputError(command_line.restart +
                       ": has all stages of this scene behind it, but with "
                       "other values (" +
                       summarized(changes) +
                       "); without --restart they are computed anew");
    return {"goes on with other values: " + summarized(changes)};
  }



  void
  Simulation::begin_output(OutputWriter &writer, const State &state)
  {
    const bool nothing_left = state.stage == parameters.stages.size();
    if (continues)
      writer.continue_from(restart);
    else
      record_stages_before(state, writer);
    writer.begin(state);
    if (nothing_left)
      {
        log.write("nothing is left to do: " + command_line.restart +
                  " has all stages of this scene behind it");
        writer.show_end(state);
      }
    else if (continues)
      log.write((boost::format("goes on from %s: stage %s, load %.4f") %
                 command_line.restart % parameters.stages[state.stage] %
                 state.load)
                  .str());
    if (!lock->holds())
      log.write(
        "this file system cannot lock: see to it that no other run has " +
        parameters.output_directory);
  }



  void
  Simulation::record_stages_before(const State  &state,
                                   OutputWriter &writer) const
  {
    for (unsigned int s = 0; s < state.stage; ++s)
      {
        StageStatistics entry;
        entry.name      = parameters.stages[s];
        entry.converged = true;
        // Numbered otherwise, as after runs that each did a part, they are
        // somebody else's.
        if (state.stage == restart.state.stage && s < restart.stages.size())
          entry = restart.stages[s];
        writer.record(s, entry);
      }
  }



  int
  Simulation::run()
  {
    check_junctions(parameters, mesh);
    State state = initial_state();
    check_compaction(parameters, state);
    // Where coating comes first, what is wrong with it shows at once.
    std::vector<std::string> notes = input_notes(parameters, fibers);
    if (state.stage < parameters.stages.size() &&
        stage_type(parameters.stages[state.stage]).adds_matrix &&
        state.matrix.is_empty())
      notes.push_back(add_matrix(parameters, mesh, state));
    for (const std::string &note : stage_notes(state))
      notes.push_back(note);
    for (const std::string &note : compare_with_restarted(state))
      notes.push_back(note);
    if (command_line.check)
      {
        print_check();
        if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
          for (const std::string &note : notes)
            std::cout << note << std::endl;
        return 0;
      }

    check_memory();
    StopRequest stop(comm,
                     parameters.output_directory,
                     parameters.maximal_wall_time,
                     start);
    if (!lock)
      lock = std::make_unique<DirectoryLock>(parameters.output_directory, comm);
    state.scene_stages = parameters.stages;
    RunIdentity run    = new_run(parameters, comm);
    if (continues)
      run.id = restart.run.id;
    log.open(parameters.output_directory,
             "run " + run.id,
             continues ? restart.output.log_size : 0);
    log_header();
    OutputWriter writer(
      {parameters, fibers, mesh}, model_size(), run, log, comm);
    begin_output(writer, state);
    for (const std::string &note : notes)
      log.write(note);
    log_what_is_left_out();
    const int status = run_stages(state, writer, stop);
    writer.write_report(command_line.file);
    log_timings(writer.stages());
    if (parameters.solver.benchmark)
      log_benchmark(writer.stages());
    if (status == 0)
      log_results();
    return status;
  }



  int
  Simulation::end_on_request(OutputWriter                &writer,
                             const StopRequest           &stop,
                             const std::function<void()> &save)
  {
    save();
    writer.write_summary();
    log.write("stopped on request (" + stop.reason() +
              "): go on with --restart " + parameters.output_directory +
              "/checkpoint");
    return 3;
  }



  StageStatistics
  Simulation::statistics_so_far(const State &state) const
  {
    const bool under_way =
      state.increment > 0 || state.step > 0 || state.coarse.q.size() > 0;
    if (under_way && restart.stages.size() > restart.state.stage)
      return restart.stages[restart.state.stage];
    StageStatistics statistics;
    statistics.name = parameters.stages[state.stage];
    return statistics;
  }



  int
  Simulation::run_stages(State &state, OutputWriter &writer, StopRequest &stop)
  {
    const unsigned int first = state.stage;
    while (state.stage < parameters.stages.size())
      {
        const unsigned int number        = state.stage;
        StageStatistics    statistics    = statistics_so_far(state);
        const double       output_before = writer.seconds();
        const auto         record        = [&]() {
          statistics.seconds.output += writer.seconds() - output_before;
          writer.record(number, statistics);
        };
        const auto fail = [&](const std::string &why) {
          log.write(why);
          record();
          writer.save(state);
          writer.write_summary();
          writer.write_report(command_line.file);
        };
        State before_last;
        try
          {
            run_stage(state, writer, stop, statistics, before_last);
          }
        catch (const StopRequested &)
          {
            record();
            return end_on_request(writer, stop, [&]() {
              if (before_last.q.size() > 0)
                writer.save_before_last(before_last);
              else
                writer.save(state);
            });
          }
        catch (const InputError &error)
          {
            if (number == first)
              throw;
            // Of the stages before there are results.
            fail(error.what());
            throw StageFailure(error.what());
          }
        catch (const StageFailure &failure)
          {
            fail(failure.what());
            throw;
          }

        state.stages_done.push_back(parameters.stages[number]);
        state.begin_stage(number + 1);
        record();
        writer.end_stage(state);
        if (state.stage < parameters.stages.size() && stop.requested())
          return end_on_request(writer, stop, [&]() { writer.save(state); });
      }
    return 0;
  }



  void
  Simulation::run_stage(State           &state,
                        OutputWriter    &writer,
                        StopRequest     &stop,
                        StageStatistics &statistics,
                        State           &before_last)
  {
    const std::string &name      = parameters.stages[state.stage];
    const auto         composite = make_composite(name, state);
    const Scene        scene{parameters, fibers, mesh, composite.get()};
    const auto         stage = create_stage(name, scene);
    const RunContext   context{generator, log, comm, [&stop]() {
                               return stop.requested();
                             }};
    writer.begin_stage(name, state, composite.get());
    {
      StageRun           run(scene, *stage, context, statistics, state);
      StageRun::Estimate estimated;
      if (parameters.solver.error_estimate)
        estimated = [&](const State &before, const State &reached) {
          estimate(scene, before, reached, statistics, stop);
        };
      run.run(
        state,
        std::ref(writer),
        estimated,
        [&](const State &begun) { writer.keep(begun, statistics); },
        ahead(scene, state));
      seconds_of_increment = run.seconds_of_increment();
      before_last          = run.before_last();
    }
    // A way that turns has been farther from its start before.
    const bool farthest = !stage->way() || stage->way()->farthest() == 1;
    if (parameters.solver.error_estimate && farthest &&
        before_last.q.size() > 0)
      estimate(scene, before_last, state, statistics, stop);
  }



  StageRun::Ahead
  Simulation::ahead(const Scene &scene, const State &state) const
  {
    StageRun::Ahead ahead{0, seconds_of_increment};
    for (unsigned int s = state.stage + 1; s < parameters.stages.size(); ++s)
      {
        const auto stage = create_stage(parameters.stages[s], scene);
        if (stage->is_test())
          ahead.increments +=
            stage->n_increments(state, 0, stage->first_step(state));
      }
    return ahead;
  }



  void
  Simulation::estimate(const Scene     &scene,
                       const State     &before,
                       const State     &reached,
                       StageStatistics &statistics,
                       StopRequest     &stop)
  {
    const bool is_test = create_stage(statistics.name, scene)->is_test();
    if (is_test)
      log.write(
        (boost::format("%-8s the error of its loading curve is estimated") %
         statistics.name)
          .str());
    {
      ScopedTimer timer(statistics.seconds.estimate);
      statistics.estimated_error = estimate_error(
        scene, {statistics.name, before, reached}, comm, [&stop]() {
          if (stop.requested())
            throw StopRequested("");
        });
    }
    if (is_test)
      for (const std::string &line : described(statistics.estimated_error))
        log.write((boost::format("%-8s %s") % statistics.name % line).str());
  }



  std::unique_ptr<Composite>
  Simulation::make_composite(const std::string &stage, State &state)
  {
    if (stage_type(stage).adds_matrix && state.matrix.is_empty())
      log.write(add_matrix(parameters, mesh, state));
    if (state.matrix.is_empty())
      return nullptr;
    return std::make_unique<Composite>(state.matrix, mesh);
  }



  std::vector<std::string>
  Simulation::stage_notes(const State &state) const
  {
    std::unique_ptr<Composite> composite;
    if (!state.matrix.is_empty())
      composite = std::make_unique<Composite>(state.matrix, mesh);
    std::vector<std::string> notes;
    for (const std::string &name : parameters.stages)
      for (const std::string &note :
           create_stage(name, {parameters, fibers, mesh, composite.get()})
             ->notes())
        if (std::find(notes.begin(), notes.end(), note) == notes.end())
          notes.push_back(note);
    return notes;
  }
} // namespace fiberloom
