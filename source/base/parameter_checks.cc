// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/accuracy.h>
#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/parameter_catalogue.h>
#include <fiberloom/base/parameters.h>
#include <fiberloom/base/vector_function.h>

#include <deal.II/base/utilities.h>

#include <boost/format.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numeric>

namespace fiberloom
{
  namespace
  {
    // Over the radius, the largest by which weaves have been compared.
    constexpr double preview_step = .7;

    // Points of the load at which functions are looked at, and at which they
    // must be finite; what is between is found where an increment ends there.
    constexpr unsigned int n_samples = 200, n_finite = 2000;

    void
    resolve_tows(TowParameters       &tows,
                 const TowParameters &crossing,
                 const double         elements_per_crossing)
    {
      if (tows.overhang == 0)
        tows.overhang = .5 * crossing.tow_spacing;
      const double crossings =
        crossing.tows - 1 + 2 * tows.overhang / crossing.tow_spacing;
      if (tows.elements_per_fiber == 0)
        tows.elements_per_fiber =
          std::lround(std::clamp(elements_per_crossing * crossings, 4., 1e9));
    }

    template <class T>
    void
    replace_zero(T &value, const T automatic)
    {
      if (value == 0)
        value = automatic;
    }

    void
    check_layers(const TowParameters &tows, const std::string &where)
    {
      const unsigned int sum =
        std::accumulate(tows.layers.begin(), tows.layers.end(), 0u);
      if (!tows.layers.empty() && sum != tows.fibers)
        throw InputError(where + ": the layers hold " + std::to_string(sum) +
                         " fibers; allowed: as many as Fibers per tow, " +
                         std::to_string(tows.fibers));
    }

    void
    check_number_of_nodes(const double nodes, const std::string &where)
    {
      if (nodes > Parameters::most_nodes)
        throw InputError(
          where + ": the model would have " +
          (boost::format("%.3g") % nodes).str() + " nodes; allowed: at most " +
          std::to_string(Parameters::most_nodes) + ", by smaller numbers");
    }

    /** Before anything of this size is built. */
    void
    check_size(const Parameters &parameters)
    {
      double nodes = 0;
      for (const bool is_warp : {true, false})
        if (const TowParameters &tows =
              is_warp ? parameters.fabric.warp : parameters.fabric.fill;
            parameters.is_fabric())
          {
            const std::string section =
              is_warp ? "Fabric/Warp/" : "Fabric/Fill/";
            if (tows.elements_per_fiber > TowParameters::most_elements)
              throw InputError(
                parameters.where(section + "Overhang") + " = " +
                exact_text(tows.overhang) +
                ": fibers this long need more than " +
                std::to_string(TowParameters::most_elements) +
                " elements; allowed: a smaller overhang, or Elements per "
                "fiber");
            nodes += double(parameters.fabric.plies) * tows.tows * tows.fibers *
                     (2 * tows.elements_per_fiber + 1);
            check_number_of_nodes(nodes,
                                  parameters.where(section + "Tows") +
                                    ", Fibers per tow, Elements per fiber and "
                                    "Plies");
          }
      if (parameters.has_matrix())
        {
          const MatrixParameters &matrix = parameters.matrix;
          const double            degree = matrix.degree;
          check_number_of_nodes((matrix.layers == Layers::both ? 2 : 1) *
                                  (degree * matrix.cells_along_x + 1) *
                                  (degree * matrix.cells_along_y + 1) *
                                  (degree * matrix.cells_through_thickness + 1),
                                parameters.where("Matrix/Cells along x") +
                                  ", along y and through thickness");
        }
    }

    using Components = std::array<bool, 3>;

    /** Three functions of t that are finite from 0 to @p end . Throws
     * InputError. */
    VectorFunction
    read_functions(const std::string &functions,
                   const double       end,
                   const std::string &where)
    {
      const std::string allowed = "; allowed: three functions of t with "
                                  "semicolons between, such as 0; 0; 0.1*t";
      const std::size_t n =
        dealii::Utilities::split_string_list(functions, ';').size();
      if (n != 3)
        throw InputError(where + ": " + std::to_string(n) + " functions" +
                         allowed);
      try
        {
          VectorFunction parsed(functions);
          for (unsigned int i = 0; i <= (parsed.is_constant() ? 0 : n_finite);
               ++i)
            if (!parsed.value(end * i / n_finite).allFinite())
              throw InputError("not finite at t = " +
                               exact_text(end * i / n_finite));
          return parsed;
        }
      catch (const InputError &error)
        {
          throw InputError(where + " = " + functions + ": " + error.what() +
                           allowed);
        }
    }

    /** Which of the components are not always 0. */
    Components
    nonzero_components(const VectorFunction &function, const double end)
    {
      Components nonzero{{false, false, false}};
      for (unsigned int i = 0; i <= n_samples; ++i)
        for (unsigned int c = 0; c < 3; ++c)
          nonzero[c] =
            nonzero[c] || function.value(end * i / n_samples)[c] != 0;
      return nonzero;
    }

    bool
    is_zero(const VectorFunction &function, const double end)
    {
      return nonzero_components(function, end) == Components();
    }

    void
    check_starts_at_zero(const VectorFunction &motion, const std::string &where)
    {
      if (motion.value(0).norm() > 1e-12)
        throw InputError(where +
                         ": it is not 0 at t = 0; allowed: the motion relative "
                         "to the start of the stage, such as 0; 0; 0.1*t");
    }

    /** Turns can be followed. */
    void
    check_turns(const VectorFunction &rotation,
                const LoadParameters &load,
                const std::string    &where)
    {
      if (!(rotation.step_within(LoadParameters::largest_turn,
                                 load.largest_step,
                                 load.end) > 0))
        throw InputError(where + ": it jumps by more than 15 degrees; "
                                 "allowed: functions without jumps");
    }

    /** That all names are those of choices; a wrong one @p is_wrong , in
     * words. */
    template <class Choice>
    void
    check_names(const NamedSet<Choice> &names,
                const std::string      &is_wrong,
                const std::string      &where)
    {
      if (names.unknown_name())
        throw InputError(where + ": " + *names.unknown_name() + " " + is_wrong +
                         "; allowed: " + all_names<Choice>(", ") +
                         " with blanks between");
    }

    void
    check_center(const GivenPoint &center, const std::string &where)
    {
      if (center.is_wrong())
        throw InputError(where + " = " + center.text() +
                         " is no point; allowed: three numbers x y z with "
                         "blanks between");
    }

    void
    check_borders(const DriveParameters &drive, const Parameters &parameters)
    {
      const std::string section = "Drive " + drive.name + "/";
      if (const auto &name = drive.matrix_borders.unknown_name())
        throw InputError(parameters.where(section + "Matrix borders") +
                         ": there is no border " + *name +
                         "; allowed: " + all_names<MatrixBorder>(", ") +
                         " with commas between");
      if (!drive.matrix_borders.empty() && !parameters.has_matrix())
        throw InputError(parameters.where(section + "Matrix borders") +
                         ": the scene has no matrix; allowed: another "
                         "Matrix/Layers than none");
      check_names(drive.matrix_held,
                  "cannot be held",
                  parameters.where(section + "Matrix held"));
    }

    void
    check_matrix_parameters(const Parameters &parameters)
    {
      const MatrixParameters &matrix = parameters.matrix;
      if (matrix.thickness <= matrix.overlap && parameters.has_matrix() &&
          matrix.layers != Layers::filled)
        throw InputError(parameters.where("Matrix/Thickness") + " = " +
                         exact_text(matrix.thickness) +
                         ": a layer is not thicker than the overlap, " +
                         exact_text(matrix.overlap) +
                         "; allowed: more than Matrix/Overlap");
      const bool coats = parameters.has_stage("coat");
      if (coats && !parameters.has_matrix())
        throw InputError(parameters.where("Stages") +
                         ": coat has nothing to do, as Matrix/Layers is none; "
                         "allowed: upper, lower, both or filled there");
    }

    /** Motion where it is free or load where it is not would be ignored. */
    void
    check_drive(const DriveParameters &drive, const Parameters &parameters)
    {
      const std::string section = "Drive " + drive.name + "/";
      check_borders(drive, parameters);
      if (drive.ends.empty() && drive.matrix_borders.empty())
        throw InputError(parameters.where(section + "Ends") +
                         ": no end is named; allowed: a list such as 0 start, "
                         "3-5 end, all at 0.5");
      check_names(drive.held,
                  "cannot be held",
                  parameters.where(section + "Held"));
      check_center(drive.center, parameters.where(section + "Center"));
      check_names(drive.free,
                  "is no degree of freedom",
                  parameters.where(section + "Free"));

      struct Quantity
      {
        std::string            name;
        const std::string     &functions;
        std::array<BodyDof, 3> dofs;
        bool                   acts_on_free;
      };
      const std::array<BodyDof, 3> along{{BodyDof::x, BodyDof::y, BodyDof::z}},
        about{{BodyDof::rx, BodyDof::ry, BodyDof::rz}};
      for (const Quantity &quantity :
           {Quantity{"Translation", drive.translation, along, false},
            Quantity{"Rotation", drive.rotation, about, false},
            Quantity{"Force", drive.force, along, true},
            Quantity{"Moment", drive.moment, about, true}})
        {
          const std::string where = parameters.where(section + quantity.name);
          const VectorFunction function =
            read_functions(quantity.functions, parameters.load.end, where);
          const Components given =
            nonzero_components(function, parameters.load.end);
          for (unsigned int i = 0; i < 3; ++i)
            {
              const BodyDof dof     = quantity.dofs[i];
              const bool    is_free = drive.free.has(dof);
              if (given[i] && is_free != quantity.acts_on_free)
                throw InputError(where + ": " + name_of(dof) + " is " +
                                 (is_free ? "" : "not ") +
                                 "free; allowed: 0 as function number " +
                                 std::to_string(i + 1) + ", or another entry " +
                                 section + "Free");
            }
          if (!quantity.acts_on_free)
            check_starts_at_zero(function, where);
          if (quantity.name == "Rotation")
            check_turns(function, parameters.load, where);
        }
    }

    void
    check_distributed_loads(const Parameters &parameters)
    {
      const LoadParameters &load = parameters.load;
      read_functions(load.line_load,
                     load.end,
                     parameters.where("Load/Line load"));
      const std::string where = parameters.where("Load/Gravity");
      const bool        heavy =
        parameters.is_fabric() ?
                 parameters.fabric.warp.density + parameters.fabric.fill.density > 0 :
                 *std::max_element(parameters.fibers.density.begin(),
                            parameters.fibers.density.end()) > 0;
      if (!is_zero(read_functions(load.gravity, load.end, where), load.end) &&
          !heavy)
        throw InputError(where + ": the fibers have no weight; allowed: " +
                         (parameters.is_fabric() ? "Fabric/Warp/" : "Fibers/") +
                         "Density above 0");
    }
    /** Of a fabric with ends, what only a cell has; of a cell, what needs
     * ends. */
    void
    check_cell(const Parameters &parameters)
    {
      const FabricParameters &fabric = parameters.fabric;
      if (fabric.periodic && !parameters.is_fabric())
        throw InputError(parameters.where("Fabric/Periodic") +
                         ": the scene has no fabric, as Fibers/" +
                         parameters.fibers.sources().front() +
                         " is given; allowed: false");
      bool is_sheared = false;
      for (const std::string &stage : parameters.stages)
        {
          const StageType     &type     = stage_type(stage);
          const StageSettings *settings = parameters.stage_settings.find(stage);
          is_sheared =
            is_sheared || (settings && !settings->keeps_right_angles());
          if (fabric.periodic && is_sheared && stage == "coat")
            throw InputError(parameters.where("Stages") +
                             ": coat needs a cell whose periods are at right "
                             "angles; allowed: coat before shear");
          if (type.needs_cell() && !fabric.periodic)
            throw InputError(parameters.where("Stages") + ": " + stage +
                             " needs a periodic cell; allowed: with "
                             "Fabric/Periodic = true");
          if (type.needs_ends() && fabric.periodic)
            throw InputError(parameters.where("Stages") + ": " + stage +
                             " needs tow ends, which a periodic cell has not; "
                             "allowed: " +
                             stage_names([](const StageType &other) {
                               return !other.needs_ends();
                             }));
        }
      for (const auto &[entry, size] :
           {std::pair{"Matrix/Size along x", parameters.matrix.size_x},
            {"Matrix/Size along y", parameters.matrix.size_y}})
        if (fabric.periodic && size > 0)
          throw InputError(parameters.where(entry) +
                           ": a periodic cell has a matrix of its own size; "
                           "allowed: 0");
      if (fabric.cell_cut.size() != 2)
        throw InputError(parameters.where("Fabric/Cell cut") + ": " +
                         std::to_string(fabric.cell_cut.size()) +
                         " numbers; allowed: two, along warp and fill");
      for (const bool is_warp : {true, false})
        {
          const TowParameters &tows     = is_warp ? fabric.warp : fabric.fill;
          const TowParameters &crossing = is_warp ? fabric.fill : fabric.warp;
          if (fabric.periodic &&
              std::abs(tows.overhang - .5 * crossing.tow_spacing) >
                1e-9 * crossing.tow_spacing)
            throw InputError(parameters.where(is_warp ?
                                                "Fabric/Warp/Overhang" :
                                                "Fabric/Fill/Overhang") +
                             " = " + exact_text(tows.overhang) +
                             ": a periodic cell has no tow ends; allowed: 0");
        }
    }

    void
    check_plies(const Parameters &parameters)
    {
      const FabricParameters &fabric = parameters.fabric;
      if (fabric.plies > 1 && !fabric.periodic)
        throw InputError(parameters.where("Fabric/Plies") + " = " +
                         std::to_string(fabric.plies) +
                         ": a stack needs a periodic cell; allowed: 1, or "
                         "Fabric/Periodic = true");
      if (const auto n = fabric.ply_shift.size();
          n != 0 && n != 2 && n != 2 * fabric.plies)
        throw InputError(parameters.where("Fabric/Ply shift") + ": " +
                         std::to_string(n) + " numbers; allowed: none, 2 or " +
                         std::to_string(2 * fabric.plies) +
                         ", two for each ply");
      const auto &turns = fabric.ply_rotation;
      if (!turns.empty() && turns.size() != fabric.plies)
        throw InputError(parameters.where("Fabric/Ply rotation") + ": " +
                         std::to_string(turns.size()) +
                         " numbers; allowed: none or " +
                         std::to_string(fabric.plies) + ", one for each ply");
      const double along  = fabric.fill.tows * fabric.fill.tow_spacing,
                   across = fabric.warp.tows * fabric.warp.tow_spacing;
      if (std::any_of(turns.begin(),
                      turns.end(),
                      [](const unsigned int n) { return n % 2 != 0; }) &&
          std::abs(along - across) > 1e-9 * along)
        throw InputError(parameters.where("Fabric/Ply rotation") +
                         ": the cell is no square, but " + exact_text(along) +
                         " mm along warp and " + exact_text(across) +
                         " mm along fill; allowed: 0 and 2");
    }

    void
    check_strength(const StrengthParameters &strength,
                   const std::string        &section,
                   const Parameters         &parameters)
    {
      if (strength.breaking_strain > 0 && strength.strength > 0)
        throw InputError(parameters.where(section + "Strength") + ": " +
                         section +
                         "Breaking strain is given, too; allowed: "
                         "one of them");
      if (strength.weibull_modulus > 0 &&
          (strength.strength == 0 || strength.reference_length == 0))
        throw InputError(parameters.where(section + "Weibull modulus") +
                         ": strengths that differ need Strength and Reference "
                         "length; allowed: both above 0, or 0 here");
    }
  } // namespace

  void
  Parameters::resolve()
  {
    if (is_preview())
      resolve_preview();
    if (!accuracy.percent())
      throw InputError(where("Accuracy") + " = " + accuracy.text() +
                       " is not allowed; allowed: " + allowed_accuracies);
    const AccuracySettings settings = settings_for(*accuracy.percent());
    resolve_tows(fabric.warp, fabric.fill, settings.elements_per_crossing);
    resolve_tows(fabric.fill, fabric.warp, settings.elements_per_crossing);
    if (fibers.elements_per_fiber == 0)
      fibers.elements_per_fiber = std::lround(settings.elements_per_fiber);
    replace_zero(contact.largest_penetration, settings.largest_penetration);
    replace_zero(contact.stations_per_element, settings.stations_per_element);
    replace_zero(solver.contact_tolerance, settings.contact_tolerance);
    // absolute, so that the values in force repeat the run from anywhere
    if (!fibers.file.empty())
      fibers.file = std::filesystem::absolute(
                      std::filesystem::path(source).parent_path() / fibers.file)
                      .lexically_normal();
    resolve_matrix();
    stage_settings.resolve();
    load.first_step = std::min(load.first_step, load.largest_step);
  }

  void
  Parameters::resolve_preview()
  {
    if (stages.empty() || stages.front() != "weave" || !is_fabric())
      throw InputError(where("Accuracy") +
                       " = preview shows how a fabric is woven; allowed where "
                       "Stages begins with weave and no fibers are given");
    stages.resize(1);
    const auto coarsen = [](TowParameters &tows, const unsigned int crossed) {
      const unsigned int coarsest = TowParameters::least_elements * crossed;
      if (tows.elements_per_fiber == 0 || tows.elements_per_fiber > coarsest)
        tows.elements_per_fiber = coarsest;
    };
    coarsen(fabric.warp, fabric.fill.tows);
    coarsen(fabric.fill, fabric.warp.tows);
    contact.stations_per_element = 1;
    weaving.step                 = std::max(weaving.step, preview_step);
    // Loose fibers have no use for a factor of the whole.
    if (solver.linear_solver == Preconditioning::automatic)
      solver.linear_solver = Preconditioning::rigid_sections;
    output.exports.clear();
  }



  void
  Parameters::resolve_matrix()
  {
    double radius =
      std::max(fabric.warp.fiber_radius, fabric.fill.fiber_radius);
    double       element = std::min(fabric.warp.element_length(fabric.fill),
                              fabric.fill.element_length(fabric.warp));
    unsigned int cells_along_x = 2 * fabric.fill.tows,
                 cells_along_y = 2 * fabric.warp.tows;
    if (!is_fabric())
      {
        radius  = *std::max_element(fibers.radius.begin(), fibers.radius.end());
        element = 4 * radius;
        cells_along_x = cells_along_y = 8;
      }
    replace_zero(matrix.overlap, radius);
    replace_zero(matrix.thickness, 6 * radius);
    replace_zero(matrix.junction_spacing, .5 * element);
    replace_zero(matrix.cells_along_x, cells_along_x);
    replace_zero(matrix.cells_along_y, cells_along_y);
  }

  void
  Parameters::check() const
  {
    if (output_directory.empty())
      throw InputError(where("Output directory") +
                       " is empty; allowed: a directory");
    if (stages.empty())
      throw InputError(where("Stages") +
                       " is empty; allowed: " + stage_names());
    if (const auto sources = fibers.sources(); sources.size() > 1)
      throw InputError(where("Fibers/" + sources[1]) + ": Fibers/" +
                       sources[0] + " is given, too; allowed: one of them");
    for (const std::string &stage : stages)
      {
        // Whether a file has a fabric shows when it is read.
        if (!is_fabric() && fibers.file.empty() &&
            stage_type(stage).needs_fabric())
          throw InputError(
            where("Stages") + ": " + stage + " needs a fabric, but Fibers/" +
            fibers.sources().front() +
            " is given; allowed: " + stage_names([](const StageType &type) {
              return !type.needs_fabric();
            }));
        if (stage == "load" && drives.empty())
          throw InputError(where("Stages") +
                           ": load needs drives; name them in Drives");
      }
    for (const DriveParameters &drive : drives)
      check_drive(drive, *this);
    check_distributed_loads(*this);
    check_cell(*this);
    check_plies(*this);
    stage_settings.check(*this);
    check_strength(fabric.warp.strength, "Fabric/Warp/", *this);
    check_strength(fabric.fill.strength, "Fabric/Fill/", *this);
    check_strength(fibers.strength, "Fibers/", *this);
    if (output.only_summary && !output.exports.empty())
      throw InputError(where("Output/Export") +
                       ": Output/Only summary is true, so nothing would be "
                       "exported; allowed: one of the two");
    check_matrix_parameters(*this);
    check_size(*this);

    check_layers(fabric.warp, where("Fabric/Warp/Layers"));
    check_layers(fabric.fill, where("Fabric/Fill/Layers"));
  }

  void
  Parameters::check_stage_order(const std::vector<std::string> &stages_done,
                                const unsigned int              next) const
  {
    std::vector<std::string> sequence = stages_done;
    sequence.insert(sequence.end(), stages.begin() + next, stages.end());

    if (std::count(sequence.begin(), sequence.end(), "coat") > 1)
      throw InputError(where("Stages") + ": there is a matrix already; "
                                         "allowed: coat only once");
    if (!is_fabric() && fibers.file.empty())
      return;
    for (std::size_t i = 0; i < sequence.size(); ++i)
      if ((sequence[i] == "weave") != (i == 0) &&
          (is_fabric() || sequence[i] == "weave")) // files may be woven
        throw InputError(where("Stages") + ": " +
                         (i == 0 ?
                            sequence[i] +
                              " needs a woven fabric; allowed: weave first, "
                              "or --restart from a woven state" :
                            "weave is possible only once, as the first stage"));
  }
} // namespace fiberloom
