// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// summary.json is valid JSON whatever is in it, with the names that scripts
// rely on, in their order. Numbers are numbers that read back as they were.

#include <fiberloom/output/summary.h>

#include <deal.II/base/mpi.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>

using namespace fiberloom;
using Json = nlohmann::ordered_json;

namespace
{
  Summary
  example()
  {
    Summary summary;
    summary.version           = "1.0 \"quoted\" \\ \n \xff";
    summary.revision          = "abc";
    summary.run               = "0123456789abcdef";
    summary.ranks             = 2;
    summary.converged         = true;
    summary.model.fiber_dofs  = 316008;
    summary.fabric            = {{"thickness[mm]", 0.1 + 0.2},
                                 {"areal_weight[kg/m2]", .25}};
    summary.peak_memory_bytes = 12345678901.;
    summary.stages.resize(2);
    summary.stages[0].name                            = "weave";
    summary.stages[0].newton_iterations               = 46;
    summary.stages[0].seconds.linear_solver           = 1.25;
    summary.stages[0].seconds.wall                    = std::nan("");
    summary.stages[1].name                            = "relax";
    summary.stages[1].largest_penetration_over_radius = .0215;
    summary.stages[1].largest_section_change          = .004;
    summary.stages[1].elastic_energy                  = .0195;
    summary.stages[1].estimated_error.mesh            = .0025;
    summary.stages[1].membrane_stiffness = {1, 2, 3, 4, 5, 6, 7, 8, 9.5};
    return summary;
  }



  /** One line for each value, after the names that lead to it. */
  void
  print(std::ostream &out, const std::string &names, const Json &value)
  {
    if (value.is_object())
      for (const auto &[name, member] : value.items())
        print(out, names + name + " ", member);
    else
      out << names << value << "\n";
  }
} // namespace



int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::ofstream                            out("output");

  Summary    summary = example();
  const Json json    = Json::parse(summary_json(summary));
  out << "version kept but for what is no text "
      << (json["version"] == "1.0 \"quoted\" \\ \n \xef\xbf\xbd") << "\n"
      << "numbers to the last digit "
      << (json["fabric"]["thickness[mm]"] == 0.1 + 0.2) << "\n"
      << "bytes are whole " << json["peak_memory_bytes"].is_number_unsigned()
      << "\n";
  for (const auto &[name, value] : json.items())
    if (name == "stages")
      for (const Json &stage : value)
        print(out, "", stage);
    else if (name != "version")
      print(out, name + " ", value);

  summary.stages.clear();
  summary.fabric.clear();
  const Json empty = Json::parse(summary_json(summary));
  out << "no stages " << (empty["stages"] == Json::array()) << "\n"
      << "no fabric " << !empty.contains("fabric") << "\n";

  const double memory = peak_memory_bytes(MPI_COMM_WORLD);
  out << "memory is plausible " << (memory > 1e6 && memory < 1e12) << "\n";
}
