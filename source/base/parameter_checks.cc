// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/accuracy.h>
#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/parameter_catalogue.h>
#include <fiberloom/base/parameters.h>

#include <boost/format.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>

namespace fiberloom
{
  void
  check_number_of_nodes(const double nodes, const std::string &where)
  {
    if (nodes > Parameters::most_nodes)
      throw InputError(
        where + ": the model would have " +
        (boost::format("%.3g") % nodes).str() + " nodes; allowed: at most " +
        std::to_string(Parameters::most_nodes) + ", by smaller numbers");
  }



  namespace
  {
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
      std::string sheared_by;
      for (const std::string &stage : parameters.stages)
        {
          const StageType     &type     = stage_type(stage);
          const StageSettings *settings = parameters.stage_settings.find(stage);
          if (sheared_by.empty() && settings && !settings->keeps_right_angles())
            sheared_by = stage;
          if (fabric.periodic && !sheared_by.empty() && type.adds_matrix)
            throw InputError(parameters.where("Stages") + ": " + stage +
                             " needs a cell whose periods are at right "
                             "angles; allowed: " +
                             stage + " before " + sheared_by);
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
    stage_settings.resolve(*this);
  }

  void
  Parameters::resolve_preview()
  {
    if (stages.empty() || !stage_type(stages.front()).starts_fabric ||
        !is_fabric())
      throw InputError(where("Accuracy") +
                       " = preview shows how a fabric is woven; allowed where "
                       "Stages begins with " +
                       stage_names(&StageType::starts_fabric) +
                       " and no fibers are given");
    stages.resize(1);
    const auto coarsen = [](TowParameters &tows, const unsigned int crossed) {
      const unsigned int coarsest = TowParameters::least_elements * crossed;
      if (tows.elements_per_fiber == 0 || tows.elements_per_fiber > coarsest)
        tows.elements_per_fiber = coarsest;
    };
    coarsen(fabric.warp, fabric.fill.tows);
    coarsen(fabric.fill, fabric.warp.tows);
    contact.stations_per_element = 1;
    // Loose fibers have no use for a factor of the whole.
    if (solver.linear_solver == Preconditioning::automatic)
      solver.linear_solver = Preconditioning::rigid_sections;
    output.exports.clear();
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
        if (stage_type(stage).needs_drives && drives.empty())
          throw InputError(where("Stages") + ": " + stage +
                           " needs drives; name them in Drives");
      }
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

    if (std::count_if(sequence.begin(),
                      sequence.end(),
                      [](const std::string &stage) {
                        return is_stage(stage, &StageType::adds_matrix);
                      }) > 1)
      throw InputError(where("Stages") +
                       ": there is a matrix already; allowed: " +
                       stage_names(&StageType::adds_matrix) + " only once");
    if (!is_fabric() && fibers.file.empty())
      return;
    for (std::size_t i = 0; i < sequence.size(); ++i)
      {
        const bool starts = is_stage(sequence[i], &StageType::starts_fabric);
        if (starts == (i == 0) ||
            !(is_fabric() || starts)) // files may be woven
          continue;
        throw InputError(where("Stages") + ": " + sequence[i] +
                         (starts ?
                            " is possible only once, as the first stage" :
                            " needs a woven fabric; allowed: " +
                              stage_names(&StageType::starts_fabric) +
                              " first, or --restart from a woven state"));
      }
  }
} // namespace fiberloom
