// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/parameters.h>
#include <fiberloom/base/parsed_functions.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <regex>
#include <set>
#include <sstream>

namespace fiberloom
{
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
          std::max(4l, std::lround(elements_per_crossing * crossings));
    }

    template <class T>
    T
    by_accuracy(const std::string &accuracy,
                const T            draft,
                const T            standard,
                const T            fine)
    {
      return accuracy == "draft" ? draft : accuracy == "fine" ? fine : standard;
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

    using Components = std::array<bool, 3>;

    /** Which of three functions of t differ from "0". Throws InputError. */
    Components
    check_functions(const std::string &functions, const std::string &where)
    {
      const std::string allowed = "; allowed: three functions of t with "
                                  "semicolons between, such as 0; 0; 0.1*t";
      const std::vector<std::string> parts =
        dealii::Utilities::split_string_list(functions, ';');
      if (parts.size() != 3)
        throw InputError(where + ": " + std::to_string(parts.size()) +
                         " functions" + allowed);

      try
        {
          const ParsedFunctions<1> parsed(functions, 3, "t");
          for (unsigned int i = 0; i < 3; ++i)
            for (const double t : {0., .5, 1.})
              if (!std::isfinite(parsed.value(dealii::Point<1>(t), i)))
                throw InputError("not finite");
        }
      catch (const InputError &error)
        {
          throw InputError(where + " = " + functions + ": " + error.what() +
                           allowed);
        }

      return {{parts[0] != "0", parts[1] != "0", parts[2] != "0"}};
    }

    std::set<std::string>
    check_free(const std::string &free, const std::string &where)
    {
      static const std::set<std::string> names = {
        "x", "y", "z", "rx", "ry", "rz"};
      std::istringstream    in(free);
      std::set<std::string> found;
      for (std::string name; in >> name;)
        {
          if (names.count(name) == 0)
            throw InputError(where + ": " + name +
                             " is no degree of freedom; allowed: x, y, z, rx, "
                             "ry, rz with blanks between");
          found.insert(name);
        }
      return found;
    }

    void
    check_ends(const std::string &ends, const std::string &where)
    {
      const std::regex end("\\d{1,9} (start|end)");
      const auto       list = dealii::Utilities::split_string_list(ends, ',');
      if (list.empty())
        throw InputError(where + ": no end is named; allowed: a list such as "
                                 "0 start, 0 end, 3 start");
      for (const std::string &text : list)
        if (!std::regex_match(text, end))
          throw InputError(where + ": \"" + text +
                           "\" is no end of a fiber; allowed: a list such as "
                           "0 start, 0 end, 3 start");
    }

    /** Motion where it is free or load where it is not would be ignored. */
    void
    check_drive(const DriveParameters &drive, const Parameters &parameters)
    {
      const std::string section = "Drive " + drive.name + "/";
      check_ends(drive.ends, parameters.where(section + "Ends"));
      const std::set<std::string> free =
        check_free(drive.free, parameters.where(section + "Free"));

      struct Quantity
      {
        std::string        name;
        const std::string &functions;
        std::string        prefix;
        bool               acts_on_free;
      };
      for (const Quantity &quantity :
           {Quantity{"Translation", drive.translation, "", false},
            Quantity{"Rotation", drive.rotation, "r", false},
            Quantity{"Force", drive.force, "", true},
            Quantity{"Moment", drive.moment, "r", true}})
        {
          const std::string where = parameters.where(section + quantity.name);
          const Components  given = check_functions(quantity.functions, where);
          for (unsigned int i = 0; i < 3; ++i)
            {
              const std::string dof     = quantity.prefix + "xyz"[i];
              const bool        is_free = free.count(dof) > 0;
              if (given[i] && is_free != quantity.acts_on_free)
                throw InputError(where + ": " + dof + " is " +
                                 (is_free ? "" : "not ") +
                                 "free; allowed: 0 as function number " +
                                 std::to_string(i + 1) + ", or another entry " +
                                 section + "Free");
            }
        }
    }
  } // namespace

  void
  Parameters::resolve()
  {
    const double elements = by_accuracy(accuracy, 4., 6., 10.);
    resolve_tows(fabric.warp, fabric.fill, elements);
    resolve_tows(fabric.fill, fabric.warp, elements);

    replace_zero(contact.largest_penetration,
                 by_accuracy(accuracy, .02, .02, .01));
    replace_zero(contact.stations_per_element,
                 by_accuracy(accuracy, 1., 2., 4.));
    replace_zero(solver.contact_tolerance,
                 by_accuracy(accuracy, 2e-2, 1e-2, 1e-3));
    // absolute, so that the values in force repeat the run from anywhere
    if (!fibers.file.empty())
      fibers.file = std::filesystem::absolute(
                      std::filesystem::path(source).parent_path() / fibers.file)
                      .lexically_normal();
    biaxial.first_step = std::min(biaxial.first_step, biaxial.largest_step);
    load.first_step    = std::min(load.first_step, load.largest_step);
  }

  void
  Parameters::check() const
  {
    if (output_directory.empty())
      throw InputError(where("Output directory") +
                       " is empty; allowed: a directory");
    if (stages.empty())
      throw InputError(where("Stages") +
                       " is empty; allowed: weave, relax, biaxial, load");
    if (const auto sources = fibers.sources(); sources.size() > 1)
      throw InputError(where("Fibers/" + sources[1]) + ": Fibers/" +
                       sources[0] + " is given, too; allowed: one of them");
    for (const std::string &stage : stages)
      {
        if (!is_fabric() && stage != "load")
          throw InputError(where("Stages") + ": " + stage +
                           " needs a fabric, but Fibers/" +
                           fibers.sources().front() +
                           " is given; "
                           "allowed: load");
        if (stage == "load" && drives.empty())
          throw InputError(where("Stages") +
                           ": load needs drives; name them in Drives");
      }
    for (const DriveParameters &drive : drives)
      check_drive(drive, *this);

    check_layers(fabric.warp, where("Fabric/Warp/Layers"));
    check_layers(fabric.fill, where("Fabric/Fill/Layers"));
  }

  void
  Parameters::check_stage_order(
    const std::vector<std::string> &stages_done) const
  {
    if (!is_fabric())
      return;

    const bool goes_on =
      stages_done.size() <= stages.size() &&
      std::equal(stages_done.begin(), stages_done.end(), stages.begin());
    std::vector<std::string> sequence;
    if (!goes_on)
      sequence = stages_done;
    sequence.insert(sequence.end(), stages.begin(), stages.end());

    for (std::size_t i = 0; i < sequence.size(); ++i)
      if ((sequence[i] == "weave") != (i == 0))
        throw InputError(where("Stages") + ": " +
                         (i == 0 ?
                            sequence[i] +
                              " needs a woven fabric; allowed: weave first, "
                              "or --restart from a woven state" :
                            "weave is possible only once, as the first stage"));
  }
} // namespace fiberloom
