// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/scoped_timer.h>
#include <fiberloom/base/version.h>

#include <fiberloom/beams/breakage.h>

#include <fiberloom/contact/contact_exchange.h>

#include <fiberloom/output/breaks.h>
#include <fiberloom/output/contact_field.h>
#include <fiberloom/output/exports.h>
#include <fiberloom/output/fiber_field.h>
#include <fiberloom/output/files.h>
#include <fiberloom/output/matrix_field.h>
#include <fiberloom/output/section_field.h>
#include <fiberloom/output/slices.h>
#include <fiberloom/output/trajectories.h>
#include <fiberloom/output/weave_picture.h>
#include <fiberloom/output/writer.h>

#include <deal.II/base/mpi.h>

#include <vtkObject.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iomanip>
#include <sstream>

namespace fiberloom
{
  namespace
  {
    double
    field_time(const State &state)
    {
      return state.stage + state.load;
    }

    std::string
    increment_label(const std::string &stage, const unsigned int increment)
    {
      std::ostringstream label;
      label << stage << "_" << std::setw(4) << std::setfill('0') << increment;
      return label.str();
    }

    /** Name of a stage in files; with its number where the name came before. */
    std::string
    stage_label(const Parameters &parameters, const unsigned int number)
    {
      const auto &stages  = parameters.stages;
      const auto  current = stages.begin() + number;
      return *current +
             (std::find(stages.begin(), current, *current) == current ?
                "" :
                "_" + std::to_string(number)) +
             (parameters.is_preview() ? "_preview" : "");
    }

    bool
    is_due(const unsigned int every, const IncrementReport &report)
    {
      return report.last || (every > 0 && report.state.increment % every == 0);
    }
  } // namespace



  OutputWriter::OutputWriter(const Scene       &scene,
                             const ModelSize   &model,
                             const RunIdentity &run,
                             Log               &log,
                             const MPI_Comm     comm)
    : parameters(scene.parameters)
    , fibers(scene.fibers)
    , mesh(scene.mesh)
    , identity(run)
    , log(log)
    , comm(comm)
    , model_description(describe_model(fibers, mesh))
    , fiber_series(parameters.output_directory, "fibers", comm)
    , section_series(parameters.output_directory, "sections", comm)
    , contact_series(parameters.output_directory, "contacts", comm)
    , matrix_series(parameters.output_directory, "matrix", comm)
    , junction_series(parameters.output_directory, "junctions", comm)
  {
    summary.version  = program_version();
    summary.revision = program_revision();
    summary.run      = run.id;
    summary.preview  = parameters.is_preview();
    summary.model    = model;
    summary.ranks    = dealii::Utilities::MPI::n_mpi_processes(comm);
    // What goes wrong is thrown with one line; VTK would add its own.
    vtkObject::GlobalWarningDisplayOff();
  }



  void
  OutputWriter::continue_from(const Checkpoint &checkpoint)
  {
    const State        &state  = checkpoint.state;
    const OutputRecord &output = checkpoint.output;
    goes_on                    = true;
    statistics                 = checkpoint.stages;
    for (FieldSeries *fields : series())
      if (const auto former = output.fields.find(fields->series());
          former != output.fields.end())
        fields->continue_from(former->second, field_time(state));
    curve.continue_columns(output.columns);
    for (IncrementTable *table : tables())
      if (const auto former = output.tables.find(table->file());
          former != output.tables.end())
        table->continue_from(former->second,
                             parameters.stages,
                             state.stage,
                             state.increment);
  }



  void
  OutputWriter::begin(const State &state)
  {
    collectively(comm, [&]() {
      if (!is_first_rank())
        return;
      if (!goes_on)
        keep_former_checkpoint();
      if (parameters.output.only_summary)
        return;
      write_file(path("parameters.prm"),
                 "# Values in force of run " + identity.id + "\n" +
                   identity.asked);
      for (const IncrementTable *table : tables())
        write_file(path(table->file()), table->str(), Durability::on_disk);
    });
    write_summary_at(state);
  }



  void
  OutputWriter::keep_former_checkpoint()
  {
    std::error_code ignored;
    if (!std::filesystem::exists(
          std::filesystem::symlink_status(path("checkpoint"), ignored)))
      return;
    rename_file(path("checkpoint"),
                path("checkpoint.before"),
                Durability::on_disk);
    log.write("the checkpoint of the run before is kept as " +
              path("checkpoint.before"));
  }



  void
  OutputWriter::begin_stage(const std::string &stage,
                            const State       &state,
                            const Composite   *composite)
  {
    const ScopedTimer guard(output_seconds);
    log_size = log.size();
    count(composite);
    if (parameters.output.only_summary)
      return;
    write_breaks(state.fibers);
    if (state.increment > 0)
      return;
    const std::string label =
      increment_label(stage_label(parameters, state.stage), 0);
    write_slices(state, stage, label);
    if (!fiber_series.has(field_time(state)))
      write_fields(state, {}, composite, label);
  }



  void
  OutputWriter::operator()(const IncrementReport &report)
  {
    const ScopedTimer guard(output_seconds);
    const State      &state = report.state;
    if (state.increment == 0)
      {
        // Where a stage begins; the checkpoint at the end of the one before
        // leads here.
        if (!parameters.output.only_summary)
          write_tables(report);
        return;
      }

    statistics_before = statistics;
    log_size_before   = log_size;
    log_size          = log.size();

    StageStatistics entry  = report.statistics;
    entry.converged        = report.last;
    entry.contact_elements = report.contacts.size();
    record(state.stage, entry);
    summary.model.contact_elements = report.contacts.size();

    if (report.last)
      measure({state.stage, report.stage, state.increment, 1}, state.q);
    if (!parameters.output.only_summary)
      write_files(report);
    if (report.last)
      {
        statistics[state.stage].seconds.output += guard.elapsed();
        statistics[state.stage].seconds.wall += guard.elapsed();
        // What is left, such as the estimated error, is not in a state: killed
        // on the way to it, a run does the increment again.
        write_summary();
      }
    else if (!parameters.output.only_summary &&
             is_due(parameters.output.checkpoint_every, report))
      save(state);
  }



  void
  OutputWriter::write_files(const IncrementReport &report)
  {
    const State      &state = report.state;
    const std::string label = stage_label(parameters, state.stage);
    write_tables(report);
    write_breaks(state.fibers);
    if (is_due(parameters.output.slices_every, report))
      write_slices(state,
                   report.stage,
                   increment_label(label, state.increment));
    if (is_due(parameters.output.fields_every, report))
      write_fields(state,
                   report.contacts,
                   report.composite,
                   increment_label(label, state.increment));
    if (report.last)
      write_end_of_stage(report, label);
  }



  void
  OutputWriter::show_end(const State &state)
  {
    const ScopedTimer guard(output_seconds);
    if (fabric.rows().empty())
      measure({static_cast<unsigned int>(parameters.stages.size() - 1),
               parameters.stages.back(),
               0,
               1},
              state.q);
    if (!parameters.output.only_summary)
      collectively(comm, [&]() {
        if (!is_first_rank())
          return;
        if (fibers.pattern)
          write_file(path(fabric.file()), fabric.str(), Durability::on_disk);
        write_exports(parameters, fibers, mesh, state.q);
      });
    write_summary_at(state);
  }



  void
  OutputWriter::measure(const IncrementTable::Place &place, const DofVector &q)
  {
    if (!fibers.pattern)
      return;
    const auto part = part_between_crossings(fibers, mesh, q);
    if (part)
      fabric.append(place, fabric_measures(fibers, mesh, q, *part));
    else
      log.write("the fabric is not measured: it is not flat, or has less than "
                "two tows in a direction");
  }



  void
  OutputWriter::end_stage(const State &state)
  {
    // Nothing is to go on from a preview as if it were in balance.
    if (!parameters.output.only_summary && !parameters.is_preview())
      save(state);
    write_summary_at(state);
  }



  void
  OutputWriter::keep(const State &state, const StageStatistics &so_far)
  {
    const ScopedTimer guard(output_seconds);
    if (parameters.output.only_summary ||
        parameters.output.checkpoint_every == 0 || parameters.is_preview())
      return;
    record(state.stage, so_far);
    save(state);
  }



  void
  OutputWriter::save(const State &state)
  {
    log.synchronise();
    write_checkpoint(path("checkpoint"),
                     {state, statistics, identity, output_record(log.size())},
                     model_description,
                     comm);
  }



  void
  OutputWriter::save_before_last(const State &before)
  {
    write_checkpoint(
      path("checkpoint"),
      {before, statistics_before, identity, output_record(log_size_before)},
      model_description,
      comm);
  }



  OutputRecord
  OutputWriter::output_record(const std::uint64_t log_size)
  {
    OutputRecord record;
    for (const IncrementTable *table : tables())
      record.tables[table->file()] = table->str();
    record.columns = curve.described_columns();
    for (const FieldSeries *fields : series())
      record.fields[fields->series()] = fields->entries();
    record.log_size = log_size;
    return record;
  }



  void
  OutputWriter::write_summary_at(const State &state)
  {
    summary.converged = state.stage == parameters.stages.size();
    write_summary_file();
  }



  void
  OutputWriter::write_summary()
  {
    summary.converged = false;
    write_summary_file();
  }



  void
  OutputWriter::write_summary_file()
  {
    summary.stages            = statistics;
    summary.fabric            = fabric.last();
    summary.peak_memory_bytes = peak_memory_bytes(comm);
    collectively(comm, [&]() {
      if (is_first_rank())
        write_file(path("summary.json"),
                   summary_json(summary),
                   Durability::on_disk);
    });
  }



  void
  OutputWriter::write_report(const std::string &scene)
  {
    if (parameters.output.only_summary)
      return;
    collectively(comm, [&]() {
      if (!is_first_rank())
        return;
      Report report{scene, identity.asked, summary, curve, {}, {}};
      for (unsigned int s = 0; s < statistics.size(); ++s)
        if (const auto pictures = pictures_of_stage(s); !pictures.empty())
          {
            report.earlier.insert(report.earlier.end(),
                                  report.last.begin(),
                                  report.last.end());
            report.last = pictures;
          }
      write_file(path("report.html"), report_html(report));
    });
  }



  std::vector<ReportPicture>
  OutputWriter::pictures_of_stage(const unsigned int stage) const
  {
    // What a stage that is not done would have written may be of a run before.
    if (!parameters.output.pictures || !statistics[stage].converged)
      return {};
    const std::string          label = stage_label(parameters, stage);
    std::vector<ReportPicture> pictures;
    if (const std::string view = path("pictures/view_" + label + ".png");
        std::filesystem::exists(view))
      pictures.push_back({view, "at the end of stage " + label});
    unsigned int last = 0;
    for (const IncrementTable::Row &row : curve.rows())
      if (row.stage_index == stage)
        last = row.increment;
    for (const std::string &slice :
         slices_of_increment(path("slices"), increment_label(label, last)))
      {
        const std::string name = std::filesystem::path(slice).stem();
        pictures.push_back(
          {slice,
           "slice " + name.substr(0, name.find("_" + label)) + ", " + label});
      }
    return pictures;
  }



  void
  OutputWriter::count(const Composite *composite)
  {
    if (composite == nullptr)
      return;
    summary.model.matrix_cells = composite->matrix().n_cells();
    summary.model.matrix_dofs  = 3 * composite->matrix().n_nodes();
    summary.model.junctions    = composite->junctions().size();
  }



  std::string
  OutputWriter::path(const std::string &file) const
  {
    return parameters.output_directory + "/" + file;
  }



  bool
  OutputWriter::is_first_rank() const
  {
    return dealii::Utilities::MPI::this_mpi_process(comm) == 0;
  }



  void
  OutputWriter::record(const unsigned int stage, const StageStatistics &entry)
  {
    if (statistics.size() <= stage)
      statistics.resize(stage + 1);
    statistics[stage] = entry;
  }



  void
  OutputWriter::write_fields(const State                       &state,
                             const std::vector<ContactElement> &contacts,
                             const Composite                   *composite,
                             const std::string                 &label)
  {
    const double time = field_time(state);
    const auto [first_fiber, last_fiber] =
      part_of_rank(comm, mesh.lines().size());
    const auto [first_contact, last_contact] =
      part_of_rank(comm, contacts.size());

    fiber_series.write(fiber_field(mesh,
                                   state.q,
                                   first_fiber,
                                   last_fiber,
                                   can_break(fibers) ? &state.fibers : nullptr),
                       time,
                       label);
    section_series.write(section_field(mesh,
                                       state,
                                       first_fiber,
                                       last_fiber,
                                       parameters.output.section_points),
                         time,
                         label);
    contact_series.write(
      contact_field(mesh, state.q, contacts, first_contact, last_contact),
      time,
      label);
    if (composite == nullptr)
      return;
    const auto [first_cell, last_cell] =
      part_of_rank(comm, composite->matrix().n_cells());
    const auto [first_junction, last_junction] =
      part_of_rank(comm, composite->junctions().size());
    matrix_series.write(
      matrix_field(*composite, state.q, first_cell, last_cell), time, label);
    junction_series.write(
      junction_field(*composite, state.q, first_junction, last_junction),
      time,
      label);
  }



  void
  OutputWriter::write_slices(const State       &state,
                             const std::string &stage,
                             const std::string &label)
  {
    collectively(comm, [&]() {
      if (!is_first_rank())
        return;
      for (const SlicePlane &plane :
           slice_planes(fibers, mesh, state.q, parameters.output.slices))
        {
          std::filesystem::create_directories(path("slices"));
          const auto         outlines = cut_fibers(mesh, state.q, plane);
          const std::string  file = path("slices/" + plane.name + "_" + label);
          std::ostringstream title;
          title << "stage " << stage << ", load " << std::setprecision(3)
                << state.load << ", " << plane.title;
          write_file(file + ".vtp", slice_polydata(fibers, plane, outlines));
          if (parameters.output.pictures)
            write_file(file + ".svg",
                       slice_picture(fibers, outlines, title.str()));
        }
    });
  }



  void
  OutputWriter::write_tables(const IncrementReport &report)
  {
    collectively(comm, [&]() {
      if (!is_first_rank())
        return;
      curve.append(place_of(report), report.curve);
      reactions.append(report);
      const auto durability =
        is_due(parameters.output.checkpoint_every, report) ?
          Durability::on_disk :
          Durability::none;
      for (const IncrementTable *table : tables())
        write_file(path(table->file()), table->str(), durability);
    });
  }



  void
  OutputWriter::write_breaks(const FiberHistory &history)
  {
    if (!can_break(fibers))
      return;
    collectively(comm, [&]() {
      if (is_first_rank())
        write_file(path("breaks.csv"),
                   breaks_csv(mesh, history),
                   Durability::on_disk);
    });
  }



  std::vector<IncrementTable *>
  OutputWriter::tables()
  {
    std::vector<IncrementTable *> all = {&curve, &reactions};
    if (fibers.pattern)
      all.push_back(&fabric);
    return all;
  }



  std::array<FieldSeries *, 5>
  OutputWriter::series()
  {
    return {{&fiber_series,
             &section_series,
             &contact_series,
             &matrix_series,
             &junction_series}};
  }



  void
  OutputWriter::write_pictures(const IncrementReport &report,
                               const std::string     &label)
  {
    collectively(comm, [&]() {
      if (!is_first_rank())
        return;
      std::filesystem::create_directories(path("pictures"));
      write_file(path("pictures/view_" + label + ".png"),
                 weave_picture(fibers,
                               mesh,
                               report.state.q,
                               report.composite,
                               parameters.output.neighbors ?
                                 Neighbors::shown :
                                 Neighbors::hidden));
      const std::string drawing = curve_picture(curve, report.state.stage);
      if (!drawing.empty())
        write_file(path("pictures/loading_curve_" + label + ".svg"), drawing);
    });
  }



  namespace
  {
    /** @p values : 3 x 3 [N/mm], row by row. */
    std::string
    stiffness_csv(const std::vector<double> &values)
    {
      const std::array<std::string, 3> names = {{"warp", "fill", "shear"}};
      std::string text = "force_per_width_by_strain[N/mm],warp,fill,shear\n";
      for (unsigned int i = 0; i < 3; ++i)
        {
          text += names[i];
          for (unsigned int j = 0; j < 3; ++j)
            text += "," + table_cell(values.at(3 * i + j));
          text += "\n";
        }
      return text;
    }
  } // namespace



  void
  OutputWriter::write_end_of_stage(const IncrementReport &report,
                                   const std::string     &label)
  {
    if (parameters.output.pictures)
      write_pictures(report, label);
    if (parameters.is_preview())
      return;
    collectively(comm, [&]() {
      if (!is_first_rank())
        return;
      write_file(path("trajectories.csv"),
                 trajectories_csv(fibers, mesh, report.state.q),
                 Durability::on_disk);
      if (!report.statistics.membrane_stiffness.empty())
        write_file(path("stiffness.csv"),
                   stiffness_csv(report.statistics.membrane_stiffness),
                   Durability::on_disk);
      if (report.state.stage + 1 == parameters.stages.size())
        write_exports(parameters, fibers, mesh, report.state.q);
    });
  }
} // namespace fiberloom
