// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// Printed parameters are a valid file that has the same values to the last
// digit, with text and unit before each entry, for every scene; overrides and
// automatic values are what they should be.

#include <fiberloom/base/parameter_catalogue.h>
#include <fiberloom/base/parameters.h>

#include <fiberloom/fabric/fabric_parameters.h>

#include <fiberloom/stages/biaxial.h>

#include <filesystem>
#include <fstream>
#include <sstream>

using namespace fiberloom;

Parameters
read(const std::string &file, const std::vector<std::string> &overrides = {})
{
  Parameters parameters = Parameters::parse(file, overrides);
  resolve_fabric(parameters);
  return parameters;
}

std::string
printed(const Parameters &parameters)
{
  std::ostringstream text;
  parameters.print(text);
  return text.str();
}

bool
survives_printing(const Parameters &parameters)
{
  const std::string once = printed(parameters);
  std::ofstream("printed.prm") << once;
  const Parameters again = read("printed.prm");
  return printed(again) == once &&
         again.output.exports == parameters.output.exports;
}

/** Entries that do not follow a comment. */
unsigned int
n_without_text(const std::string &prm)
{
  std::istringstream in(prm);
  unsigned int       n = 0;
  std::string        before;
  for (std::string line; std::getline(in, line); before = line)
    if (line.find("set ") == line.find_first_not_of(' ') &&
        line.find("set ") != std::string::npos)
      n += before.find('#') != before.find_first_not_of(' ') ||
           before.find('#') == std::string::npos;
  return n;
}

void
check_scenes(std::ostream &output)
{
  unsigned int n_scenes = 0, n_surviving = 0, n_texts_missing = 0;
  for (const auto &entry :
       std::filesystem::recursive_directory_iterator(SOURCE_DIR "/../prm"))
    if (entry.path().extension() == ".prm")
      {
        const Parameters parameters = read(entry.path().string());
        ++n_scenes;
        n_surviving += survives_printing(parameters);
        n_texts_missing += n_without_text(printed(parameters));
      }
  output << "at least seven scenes: " << (n_scenes >= 7)
         << ", changed by printing: " << n_scenes - n_surviving
         << ", entries without text: " << n_texts_missing << std::endl;
  output << "unit in the text: "
         << (printed(Parameters()).find("# Radius of the round fibers [mm].") !=
             std::string::npos)
         << std::endl;
}

void
check_digits(std::ostream &output)
{
  std::ofstream("awkward.prm")
    << "subsection Fabric\n"
       "  subsection Warp\n"
       "    set Fiber radius = 0.0081234567890123456\n"
       "    set Tow spacing = .3\n"
       "  end\n"
       "  subsection Fill\n"
       "    set Same as warp = true\n"
       "    set Tows = 5\n"
       "  end\n"
       "end\n"
       "set Stages = weave, \\\n"
       "             relax # and no more\n";
  const Parameters parameters =
    read("awkward.prm", {"Biaxial/Strain ratio = 0.1", "Output directory=a=b"});
  output << "awkward: " << survives_printing(parameters) << ' '
         << read("printed.prm").fabric.fill.fiber_radius * 100 << ' '
         << (parameters.fabric.warp.fiber_radius == 0.0081234567890123456)
         << std::endl
         << "warp to fill: " << parameters.fabric.fill.tows << ' '
         << parameters.fabric.fill.tow_spacing << std::endl
         << "overrides: "
         << parameters.stage_settings.get<BiaxialSettings>().strain_ratio << ' '
         << parameters.output_directory << std::endl
         << "stages: " << parameters.stages.size() << std::endl;
  output << exact_text(.1) << ' ' << exact_text(73000) << ' '
         << exact_text(1. / 3) << std::endl;
}

void
check_automatic_values(std::ostream &output)
{
  std::ofstream("automatic.prm") << "subsection Fabric\nsubsection Fill\n"
                                    "set Tows = 2\nset Tow spacing = .5\n"
                                    "end\nend\n";
  for (const std::string accuracy : {"draft",
                                     "standard",
                                     "fine",
                                     "10 %",
                                     "2%",
                                     ".5 %",
                                     "20 %",
                                     "1 %",
                                     "0.2 %"})
    {
      const Parameters p = read("automatic.prm", {"Accuracy=" + accuracy});
      output << accuracy << ": elements " << p.fabric.warp.elements_per_fiber
             << ' ' << p.fabric.fill.elements_per_fiber << ", overhang "
             << p.fabric.warp.overhang << ' ' << p.fabric.fill.overhang
             << ", penetration " << p.contact.largest_penetration
             << ", stations " << p.contact.stations_per_element
             << ", tolerance " << p.solver.contact_tolerance << std::endl;
    }
  const Parameters p =
    read("automatic.prm",
         {"Accuracy=fine", "Contact/Largest penetration=0.03"});
  output << "set alone: " << p.contact.largest_penetration << std::endl;
}

int
main()
{
  std::ofstream output("output");
  check_scenes(output);
  check_digits(output);
  check_automatic_values(output);
}
