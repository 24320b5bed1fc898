// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// summary.json is valid JSON whatever is in it, with the names that scripts
// rely on.

#include <fiberloom/output/summary.h>

#include <deal.II/base/mpi.h>

#include <boost/property_tree/json_parser.hpp>

#include <cmath>
#include <fstream>
#include <sstream>

using namespace fiberloom;

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::ofstream                            out("output");

  Summary summary;
  summary.version           = "1.0 \"quoted\" \\ \n";
  summary.revision          = "abc";
  summary.run               = "0123456789abcdef";
  summary.ranks             = 2;
  summary.converged         = true;
  summary.model.fiber_dofs  = 316008;
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

  std::istringstream          text(summary_json(summary));
  boost::property_tree::ptree tree;
  boost::property_tree::read_json(text, tree);

  out << "version kept "
      << (tree.get<std::string>("version") == summary.version) << "\n";
  for (const char *name : {"program",
                           "revision",
                           "run",
                           "ranks",
                           "converged",
                           "model.fibers",
                           "model.nodes",
                           "model.fiber_elements",
                           "model.fiber_dofs",
                           "model.matrix_cells",
                           "model.matrix_dofs",
                           "model.contact_elements",
                           "model.junctions",
                           "peak_memory_bytes"})
    out << name << " " << tree.get<std::string>(name) << "\n";
  for (const auto &[key, stage] : tree.get_child("stages"))
    {
      for (const auto &[name, value] : stage)
        if (value.empty())
          out << name << " " << value.data() << "\n";
        else
          for (const auto &[part, number] : value)
            out << name << " " << part << " " << number.data() << "\n";
    }

  summary.stages.clear();
  std::istringstream empty(summary_json(summary));
  boost::property_tree::read_json(empty, tree);
  out << "no stages " << tree.get_child("stages").empty() << "\n";

  const double memory = peak_memory_bytes(MPI_COMM_WORLD);
  out << "memory is plausible " << (memory > 1e6 && memory < 1e12) << "\n";
}
