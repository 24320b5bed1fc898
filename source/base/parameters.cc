// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/parameter_catalogue.h>
#include <fiberloom/base/parameter_file.h>
#include <fiberloom/base/parameters.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <ostream>
#include <regex>
#include <set>

namespace fiberloom
{
  namespace
  {
    /** "Section/Entry=value", taken apart at the first sign. */
    struct Override
    {
      std::string path, value, origin;

      explicit Override(const std::string &text)
        : origin("--set \"" + text + "\"")
      {
        const std::size_t sign = text.find('=');
        if (sign == std::string::npos)
          throw InputError(origin + ": allowed is Section/Entry=value");
        path  = dealii::Utilities::trim(text.substr(0, sign));
        value = dealii::Utilities::trim(text.substr(sign + 1));
      }
    };

    /** The drives must be known before their sections can be declared. */
    std::vector<DriveParameters>
    find_drives(const ParameterFile            &file,
                const std::vector<std::string> &overrides)
    {
      std::string list = file.value("Drives", "");
      for (const std::string &text : overrides)
        if (const Override entry(text); entry.path == "Drives")
          list = entry.value;

      std::vector<DriveParameters> drives;
      for (const std::string &name :
           dealii::Utilities::split_string_list(list, ','))
        {
          drives.emplace_back();
          drives.back().name = name;
        }
      return drives;
    }

    void
    check_drive_names(const std::vector<DriveParameters> &drives,
                      const std::string                  &where)
    {
      std::set<std::string> names;
      for (const DriveParameters &drive : drives)
        {
          const auto is_allowed = [](const char c) {
            return std::isalnum(static_cast<unsigned char>(c)) || c == '_' ||
                   c == ' ' || c == '-';
          };
          if (drive.name.empty() ||
              !std::all_of(drive.name.begin(), drive.name.end(), is_allowed))
            throw InputError(where + ": \"" + drive.name +
                             "\" is no name; allowed: letters, digits, blanks, "
                             "_ and -");
          if (!names.insert(drive.name).second)
            throw InputError(where + ": " + drive.name +
                             " stands twice; allowed: different names");
        }
    }

    std::string
    for_table(const std::string &text)
    {
      return std::regex_replace(text, std::regex("\\|"), "\\|");
    }
  } // namespace

  std::vector<std::string>
  FibersParameters::sources() const
  {
    std::vector<std::string> given;
    if (!polylines.empty())
      given.push_back("Polylines");
    if (!file.empty())
      given.push_back("File");
    if (!curves.empty())
      given.push_back("Curves");
    if (arrangement != Arrangement::none)
      given.push_back("Arrangement");
    return given;
  }

  bool
  Parameters::has_stage(const std::string &name) const
  {
    return std::count(stages.begin(), stages.end(), name) > 0;
  }

  double
  FabricParameters::volume_over_area() const
  {
    double volume = 0;
    for (const TowParameters *tows : {&warp, &fill})
      volume += tows->fibers * M_PI * tows->fiber_radius * tows->fiber_radius /
                tows->tow_spacing;
    return volume;
  }



  Parameters
  Parameters::parse(const std::string              &file,
                    const std::vector<std::string> &overrides)
  {
    const ParameterFile parameter_file(file);
    Parameters          parameters;
    parameters.source    = file;
    parameters.locations = parameter_file.locations();
    parameters.drives    = find_drives(parameter_file, overrides);
    parameters.notes     = parameter_file.notes();
    check_drive_names(parameters.drives, parameters.where("Drives"));

    ParameterCatalogue catalogue;
    parameters.declare(catalogue);
    parameter_file.parse_into(catalogue);
    parameters.override_entries(overrides, catalogue);
    if (parameters.fabric.fill.same_as_warp)
      parameters.copy_warp_to_fill(catalogue);

    parameters.resolve();
    parameters.check();
    return parameters;
  }

  void
  Parameters::override_entries(const std::vector<std::string> &overrides,
                               ParameterCatalogue             &catalogue)
  {
    for (const std::string &text : overrides)
      {
        const Override entry(text);
        catalogue.set(entry.path, entry.value, entry.origin);
        std::string &location = locations[entry.path];
        if (location.rfind("--set", 0) == 0)
          notes.push_back(entry.origin + ": " + location +
                          " is given, too; the later one counts");
        location = entry.origin;
      }
  }

  void
  Parameters::copy_warp_to_fill(ParameterCatalogue &catalogue) const
  {
    for (const ParameterCatalogue::Entry &entry : catalogue.entries())
      if (entry.section == "Fabric/Warp" &&
          locations.count("Fabric/Fill/" + entry.name) == 0)
        catalogue.set("Fabric/Fill/" + entry.name,
                      catalogue.get(entry.path()),
                      source);
  }

  std::string
  Parameters::where(const std::string &path) const
  {
    const auto location = locations.find(path);
    if (location != locations.end())
      return location->second + ": " + path;
    return source.empty() ? path : source + ": " + path;
  }

  void
  Parameters::print(std::ostream &out) const
  {
    Parameters         copy = *this;
    ParameterCatalogue catalogue;
    copy.declare(catalogue);
    catalogue.handler().print_parameters(
      out,
      dealii::ParameterHandler::PRM |
        dealii::ParameterHandler::KeepDeclarationOrder);
  }

  void
  Parameters::print_reference(std::ostream &out)
  {
    Parameters parameters;
    parameters.drives.emplace_back();
    parameters.drives.back().name = "NAME";
    ParameterCatalogue catalogue;
    parameters.declare(catalogue);

    out << "# Parameters\n\n"
           "One consistent system of units: mm, N, MPa (so moments in N mm). "
           "This page is the output of `fiberloom --print-reference`.\n";
    std::string section = "none yet";
    for (const ParameterCatalogue::Entry &entry : catalogue.entries())
      {
        if (entry.section != section)
          out << "\n## "
              << (entry.section.empty() ? "At the top" : entry.section)
              << "\n\n| entry | default | allowed | meaning |\n"
                 "|---|---|---|---|\n";
        section = entry.section;
        out << "| " << entry.name << " | " << for_table(entry.default_value)
            << " | " << for_table(entry.allowed) << " | "
            << for_table(entry.text) << " |\n";
      }
  }
} // namespace fiberloom
