// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/fabric_declarations.h>
#include <fiberloom/base/parameter_catalogue.h>
#include <fiberloom/base/parameters.h>

namespace fiberloom
{
  namespace
  {
    void
    declare_contact(ParameterCatalogue &catalogue, ContactParameters &contact)
    {
      catalogue.enter_section("Contact");
      catalogue.add("Friction coefficient",
                    contact.friction_coefficient,
                    "Coulomb's coefficient between fibers; 0: no friction.",
                    Allowed::at_least(0));
      catalogue.add(
        "Largest penetration",
        contact.largest_penetration,
        "Penetration that the penalty is adapted to, over the fiber "
        "radius. 0: by the accuracy, 0.02 (draft, standard) or 0.01 "
        "(fine).",
        Allowed::from_to_below(0, 1));
      catalogue.add(
        "Stations per element",
        contact.stations_per_element,
        "Contact elements per beam element where fibers run along "
        "each other. 0: by the accuracy, 1 (draft), 2 (standard) or "
        "4 (fine).",
        Allowed::from_to(0, 100));
      catalogue.add("Initial stiffness",
                    contact.initial_stiffness,
                    "Penalty stiffness of a new contact, over Young's modulus "
                    "times the fiber radius: of a station half an element long "
                    "or, at the largest penetration, of a crossing.",
                    Allowed::above(0));
      catalogue.add("Line stiffness",
                    contact.line_stiffness,
                    "Penalty stiffness per length of contact [N/mm^2], kept as "
                    "it is, of a linear law; 0: from the initial stiffness, "
                    "increased until the largest penetration is met.",
                    Allowed::at_least(0));
      catalogue.add(
        "Elastic slip",
        contact.elastic_slip,
        "Reversible tangential displacement before a contact slips, "
        "over the fiber radius.",
        Allowed::above(0));
      catalogue.add("Search margin",
                    contact.search_margin,
                    "Distance between fiber surfaces up to which contacts are "
                    "made ready, over the largest fiber radius.",
                    Allowed::above(0));
      catalogue.add("Self contact",
                    contact.self_contact,
                    "Whether parts of one fiber can touch each other; "
                    "automatic: unless the scene is a fabric.");
      catalogue.leave_section();
    }

    void
    declare_iterations(ParameterCatalogue &catalogue, SolverParameters &solver)
    {
      catalogue.add("Loops",
                    solver.loops,
                    "How equilibrium is found where fibers touch. newton: "
                    "points of contact follow the fibers in one potential with "
                    "its exact Hessian, and steps are judged by energy. "
                    "nested: the paper's three loops, on detection, on normals "
                    "with friction limits, and Newton's method on the rest; a "
                    "reference for small scenes.");
      catalogue.add("Contact tolerance",
                    solver.contact_tolerance,
                    "Residual, after contacts and normals are found anew, at "
                    "which an increment is accepted, over the largest contact "
                    "force. 0: by the accuracy, 1e-3 (draft), 1e-4 (standard) "
                    "or 3e-5 (fine).",
                    Allowed::from_to_below(0, 1));
      catalogue.add("Newton tolerance",
                    solver.newton_tolerance,
                    "Residual where there is no contact, over the internal "
                    "forces.",
                    Allowed::from_to(1e-15, .1));
      catalogue.add(
        "Largest move",
        solver.largest_move,
        "Largest displacement in a Newton iteration, over the fiber "
        "radius; 0: unlimited.",
        Allowed::at_least(0));
      catalogue.add(
        "Largest contact passes",
        solver.largest_contact_passes,
        "Detections of contact in an increment before it is cut, in the nested "
        "loops.",
        Allowed::whole(1, most_iterations));
      catalogue.add(
        "Largest normal passes",
        solver.largest_normal_passes,
        "Updates of the normals for one detection, in the nested loops.",
        Allowed::whole(1, most_iterations));
      catalogue.add(
        "Largest Newton iterations",
        solver.largest_newton_iterations,
        "Newton iterations for one update of the normals, in the nested loops "
        "and where nothing touches.",
        Allowed::whole(1, most_iterations));
      catalogue.add("Largest loop iterations",
                    solver.largest_loop_iterations,
                    "Newton iterations of an increment before it is cut, since "
                    "penalties were last adapted.",
                    Allowed::whole(1, most_iterations));
      catalogue.add("Damping",
                    solver.damping,
                    "Diagonal added to the tangent while the allowed overlap "
                    "of a weave shrinks, over E r.",
                    Allowed::above(0));
      catalogue.add(
        "Line search from",
        solver.line_search_from,
        "Number of Newton iterations after which the energy must decrease, in "
        "the nested loops and where nothing touches.",
        Allowed::whole(1, most_iterations));
      catalogue.add(
        "Growth",
        solver.growth,
        "Factor by which an increment grows after one that was accepted.",
        Allowed::from_to(1, 10));
      catalogue.add("Largest cuts",
                    solver.largest_cuts,
                    "How many times in a row an increment may be halved.",
                    Allowed::whole(0, 50));
    }

    void
    declare_solver(ParameterCatalogue &catalogue, SolverParameters &solver)
    {
      catalogue.enter_section("Solver");
      declare_iterations(catalogue, solver);
      catalogue.add(
        "Linear solver",
        solver.linear_solver,
        "What preconditions the Krylov method: a factor of the "
        "tangent in double precision, in single precision (half "
        "the memory), rigid sections, a factor of their motions in single "
        "precision (a quarter), blocks, in a composite a factor of the fibers "
        "and one of the matrix, or multigrid for what has no room for a "
        "factor. automatic: a double factor, from 20,000 dofs on a single "
        "one, from 60,000 on rigid sections.");
      catalogue.add("Benchmark",
                    solver.benchmark,
                    "Times one symmetric factorisation in double precision per "
                    "stage, and reports what Newton iterations cost in its "
                    "units.",
                    Allowed::true_or_false());
      catalogue.add("Error estimate",
                    solver.error_estimate,
                    "Whether a stage with a loading curve ends with an "
                    "estimate of its error by mesh, stations, penetration and "
                    "cells of a matrix, for which systems of twice the size, "
                    "and eight times of a matrix, are solved.",
                    Allowed::true_or_false());
      catalogue.leave_section();
    }

    void
    declare_output(ParameterCatalogue &catalogue, OutputParameters &output)
    {
      catalogue.enter_section("Output");
      catalogue.add("Fields every",
                    output.fields_every,
                    "Increments between files for ParaView; 0: only at the end "
                    "of a stage.",
                    Allowed::whole(0, most_iterations));
      catalogue.add(
        "Slices",
        output.slices,
        "Family of tows whose middle one the slices cut along, across "
        "the tows of the other family.");
      catalogue.add("Slices every",
                    output.slices_every,
                    "Increments between slices; 0: only at the start and at "
                    "the end of a stage.",
                    Allowed::whole(0, most_iterations));
      catalogue.add("Section points",
                    output.section_points,
                    "Points on the border of each section that is drawn.",
                    Allowed::whole(3, 1000));
      catalogue.add("Checkpoint every",
                    output.checkpoint_every,
                    "Increments between checkpoints.",
                    Allowed::whole(1, most_iterations));
      catalogue.add("Pictures",
                    output.pictures,
                    "Whether pictures of slices, fabric and curves are drawn.",
                    Allowed::true_or_false());
      catalogue.add("Neighbors",
                    output.neighbors,
                    "Whether pictures of a periodic cell show the eight around "
                    "it, too.",
                    Allowed::true_or_false());
      catalogue.add(
        "Iterations in log",
        output.iterations,
        "Whether log.txt has a line for each Newton iteration; else the "
        "next one has a line after ten seconds without any.",
        Allowed::true_or_false());
      catalogue.add("Only summary",
                    output.only_summary,
                    "Whether nothing is written but log.txt and summary.json, "
                    "and a checkpoint where a run stops before its end.",
                    Allowed::true_or_false());
      catalogue.add(
        "Export",
        output.exports,
        "What goes to the directory export at the end of the last stage, for "
        "other programs: surface, each tow as a closed surface (.stl, .vtp); "
        "voxels, tow, fiber volume fraction and orientation in a regular grid "
        "(.vti); abaqus, the same grid as a deck of finite elements (.inp); "
        "paths, the axes of the fibers (.csv), which Fibers/File reads; "
        "texgen, tows with their sections in TexGen's XML; fibers, the axes "
        "with radius, tow and family (.vtp).");
      catalogue.add("Voxel size",
                    output.voxel_size,
                    "Edge of the voxels of Export [mm]; surfaces are found in "
                    "a grid of half of it. 0: the smallest fiber radius, or "
                    "more, so that there are a million voxels at most.",
                    Allowed::at_least(0));
      catalogue.leave_section();
    }
  } // namespace

  void
  Parameters::declare(ParameterCatalogue &catalogue)
  {
    catalogue.add("Output directory",
                  output_directory,
                  "Where everything is written; created if absent.",
                  Allowed::text_like("a directory"));
    std::string              summaries;
    std::vector<std::string> names;
    for (const StageType &type : stage_types())
      {
        names.push_back(type.name);
        summaries +=
          (summaries.empty() ? "" : ", ") + type.name + " " + type.summary;
      }
    catalogue.add("Stages",
                  stages,
                  "What is done, in this order: " + summaries + ".",
                  Allowed::list_of(Allowed::one_of(names)));
    catalogue.add("Accuracy",
                  accuracy,
                  "Error of the loading curve to aim at: sets together the "
                  "automatic values of elements per fiber, stations, "
                  "penetration and tolerance. draft is 10 %, standard 2 % and "
                  "fine 0.5 %. preview weaves coarse fibers roughly, without "
                  "balance, and leaves out all other stages.",
                  Allowed::text_like(allowed_accuracies));
    catalogue.add("Maximal wall time",
                  maximal_wall_time,
                  "Time [s] after which the run writes a checkpoint and stops; "
                  "0: unlimited.",
                  Allowed::at_least(0));
    catalogue.add("Drives",
                  drive_names,
                  "Names, chosen by the user, of rigid bodies that hold points "
                  "of fibers. Each NAME has a section Drive NAME.",
                  Allowed::list_of(Allowed::text_like("names")));
    declare_fabric(catalogue, fabric);
    declare_fibers(catalogue, fibers);
    for (DriveParameters &drive : drives)
      drive.declare(catalogue);
    declare_contact(catalogue, contact);
    stage_settings.declare(catalogue);
    declare_solver(catalogue, solver);
    declare_output(catalogue, output);
  }
} // namespace fiberloom
