// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_writer_h
#define fiberloom_output_writer_h

#include <fiberloom/base/log.h>
#include <fiberloom/base/parameters.h>
#include <fiberloom/base/run_identity.h>
#include <fiberloom/base/statistics.h>

#include <fiberloom/fabric/fiber_set.h>

#include <fiberloom/beams/fiber_mesh.h>

#include <fiberloom/stages/stage.h>

#include <fiberloom/output/checkpoint.h>
#include <fiberloom/output/curves.h>
#include <fiberloom/output/fabric_measures.h>
#include <fiberloom/output/fields.h>
#include <fiberloom/output/reactions.h>
#include <fiberloom/output/report.h>
#include <fiberloom/output/summary.h>

#include <mpi.h>

#include <array>
#include <string>
#include <vector>

namespace fiberloom
{
  /**
   * Fills the output directory while stages run. Its operator() is an
   * IncrementObserver. All functions are collective; when something cannot be
   * written they throw StageFailure on every rank, and no file under its final
   * name is ever half written.
   *
   * Time in the fields is the index of the stage plus its load. Files carry the
   * name of their stage, followed by its index where the scene has had a stage
   * of that name before: relax_0001, later relax_2_0001. The checkpoint
   * is always written last, so that the other files are never behind it; where
   * they are ahead, because the run was killed, it says what belongs to them.
   */
  class OutputWriter
  {
  public:
    /**
     * Writes nothing yet. The output directory is that of a DirectoryLock. What
     * @p scene refers to, and @p log , must outlive the writer; @p model goes
     * to summary.json, @p run to all files that a restart relies on.
     */
    OutputWriter(const Scene       &scene,
                 const ModelSize   &model,
                 const RunIdentity &run,
                 Log               &log,
                 const MPI_Comm     comm);

    /**
     * Goes on in the directory of the run that wrote @p checkpoint : keeps
     * what that run wrote up to there. Not to be called where a scene only
     * starts from the last state of another.
     */
    void
    continue_from(const Checkpoint &checkpoint);

    /**
     * Writes parameters.prm, tables and summary.json as they are so far; the
     * run is at @p state . A new run first gives the checkpoint
     * that it finds another name, so that nobody takes it for its own. To be
     * called once, before the first stage.
     */
    void
    begin(const State &state);

    /**
     * Shows the state in which a stage starts: slices, and fields unless they
     * are there already. Does nothing for a stage that is continued.
     */
    void
    begin_stage(const std::string &stage,
                const State       &state,
                const Composite   *composite = nullptr);

    /** After an accepted increment. */
    void
    operator()(const IncrementReport &report);

    /**
     * Measures and exports @p state , which has all stages behind it, as the
     * end of the last stage does. To be called after begin() where no stage is
     * left.
     */
    void
    show_end(const State &state);

    /** Checkpoint and summary.json; @p state begins the next stage. */
    void
    end_stage(const State &state);

    /** Writes the checkpoint of a stage that has no increment yet, with what
     * its statistics are so far; not where no increment has one. */
    void
    keep(const State &state, const StageStatistics &so_far);

    /** Writes the checkpoint now, as for a stage that fails or is stopped. */
    void
    save(const State &state);

    /**
     * Writes the checkpoint of the state @p before the last increment of a
     * stage, as for one that is stopped between that and its end: a restart
     * does the increment again.
     */
    void
    save_before_last(const State &before);

    /**
     * Sets the statistics of stage number @p stage of the scene, as for one
     * that ends without a last increment.
     */
    void
    record(const unsigned int stage, const StageStatistics &entry);

    /** Writes summary.json with the statistics of the stages seen so far, of a
     * run that ends before its last stage does. */
    void
    write_summary();

    /**
     * Writes report.html on the run so far, of the scene in the file @p scene ,
     * unless only a summary is asked for.
     */
    void
    write_report(const std::string &scene);

    /** Seconds spent on output so far. */
    double
    seconds() const
    {
      return output_seconds;
    }

    /** Statistics of the stages so far, those before a restart included. */
    const std::vector<StageStatistics> &
    stages() const
    {
      return statistics;
    }

  private:
    /**
     * Writes summary.json; the run has converged if no stage is left at
     * @p state .
     */
    void
    write_summary_at(const State &state);

    /** With the statistics of the stages seen so far. */
    void
    write_summary_file();

    /** For summary.json. */
    void
    count(const Composite *composite);

    std::string
    path(const std::string &file) const;

    bool
    is_first_rank() const;

    void
    keep_former_checkpoint();

    OutputRecord
    output_record(const std::uint64_t log_size);

    /** Writes all files but summary.json and the checkpoint. */
    void
    write_files(const IncrementReport &report);

    void
    write_fields(const State                       &state,
                 const std::vector<ContactElement> &contacts,
                 const Composite                   *composite,
                 const std::string                 &label);

    void
    write_slices(const State       &state,
                 const std::string &stage,
                 const std::string &label);

    void
    write_tables(const IncrementReport &report);

    /** Adds a row to fabric.csv, where there is a fabric. */
    void
    measure(const IncrementTable::Place &place, const DofVector &q);

    /** Writes breaks.csv, where fibers can break. */
    void
    write_breaks(const FiberHistory &history);

    std::vector<IncrementTable *>
    tables();

    std::array<FieldSeries *, 5>
    series();

    void
    write_pictures(const IncrementReport &report, const std::string &label);

    /** The pictures of the end of stage number @p stage that are there. */
    std::vector<ReportPicture>
    pictures_of_stage(const unsigned int stage) const;

    void
    write_end_of_stage(const IncrementReport &report, const std::string &label);

    Parameters                   parameters;
    const FiberSet              &fibers;
    const FiberMesh             &mesh;
    const RunIdentity            identity;
    Log                         &log;
    Summary                      summary;
    MPI_Comm                     comm;
    double                       output_seconds = 0;
    std::string                  model_description;
    FieldSeries                  fiber_series;
    FieldSeries                  section_series;
    FieldSeries                  contact_series;
    FieldSeries                  matrix_series;
    FieldSeries                  junction_series;
    LoadingCurve                 curve;
    ReactionTable                reactions;
    FabricTable                  fabric;
    std::vector<StageStatistics> statistics;
    bool                         goes_on = false;

    // After the last increment, and after the one before.
    std::uint64_t                log_size = 0, log_size_before = 0;
    std::vector<StageStatistics> statistics_before;
  };
} // namespace fiberloom

#endif
