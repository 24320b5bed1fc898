// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/run_identity.h>

#include <deal.II/base/mpi.h>

#include <boost/algorithm/string/predicate.hpp>
#include <boost/algorithm/string/trim.hpp>
#include <boost/format.hpp>

#include <map>
#include <random>
#include <sstream>

namespace fiberloom
{
  namespace
  {
    /** What follows @p word in @p line ; empty if it begins otherwise. */
    std::string
    rest_after(const std::string &word, const std::string &line)
    {
      return boost::starts_with(line, word) ?
               boost::trim_copy(line.substr(word.size())) :
               "";
    }

    bool
    decides_on_results(const std::string &entry)
    {
      return entry != "Output directory" && entry != "Maximal wall time" &&
             entry != "Stages" && entry != "Solver/Benchmark" &&
             !boost::starts_with(entry, "Output/");
    }

    /** Values by "Section/Entry", of those that decide on results. */
    std::map<std::string, std::string>
    entries(const std::string &text)
    {
      std::map<std::string, std::string> values;
      std::vector<std::string>           sections = {""};
      std::istringstream                 input(text);
      for (std::string line; std::getline(input, line);)
        {
          boost::trim(line);
          const std::string section = rest_after("subsection ", line);
          const std::string entry   = rest_after("set ", line);
          if (!section.empty())
            sections.push_back(sections.back() + section + "/");
          else if (line == "end" && sections.size() > 1)
            sections.pop_back();
          else if (const auto equals = entry.find('=');
                   equals != std::string::npos)
            {
              const std::string name =
                sections.back() + boost::trim_copy(entry.substr(0, equals));
              if (decides_on_results(name))
                values[name] = boost::trim_copy(entry.substr(equals + 1));
            }
        }
      return values;
    }
  } // namespace

  RunIdentity
  new_run(const Parameters &parameters, const MPI_Comm comm)
  {
    std::random_device random;
    std::ostringstream asked;
    parameters.print(asked);
    RunIdentity run{(boost::format("%08x%08x") % random() % random()).str(),
                    asked.str()};
    run.id = dealii::Utilities::MPI::broadcast(comm, run.id, 0);
    return run;
  }

  std::vector<std::string>
  changed_entries(const std::string &before, const std::string &now)
  {
    const auto               old_values = entries(before);
    std::vector<std::string> changes;
    for (const auto &[name, value] : entries(now))
      if (const auto old = old_values.find(name);
          old != old_values.end() && old->second != value)
        changes.push_back(name + " = " + value + ", which was " + old->second);
    return changes;
  }
} // namespace fiberloom
