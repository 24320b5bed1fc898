// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/output/increment_table.h>
#include <fiberloom/output/summary.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/join.hpp>

#include <cmath>
#include <cstdio>
#include <iomanip>
#include <sstream>
#include <type_traits>

namespace fiberloom
{
  namespace
  {
    template <typename Number>
    std::string
    number_json(const Number value)
    {
      std::ostringstream text;
      text << std::setprecision(15);
      if (std::isfinite(static_cast<double>(value)))
        text << value;
      else
        text << "null";
      return text.str();
    }

    std::string
    list_json(const std::vector<std::string> &values)
    {
      return "[" + boost::algorithm::join(values, ", ") + "]";
    }

    /** Members of one JSON object, one after the other. */
    class JsonObject
    {
    public:
      explicit JsonObject(const unsigned int level)
        : indent(2 * level, ' ')
      {}

      JsonObject &
      member(const std::string &name, const std::string &value)
      {
        return raw(name, quoted(value));
      }

      JsonObject &
      member(const std::string &name, const bool value)
      {
        return raw(name, value ? "true" : "false");
      }

      template <typename Number>
      std::enable_if_t<std::is_arithmetic_v<Number>, JsonObject &>
      member(const std::string &name, const Number value)
      {
        return raw(name, number_json(value));
      }

      JsonObject &
      raw(const std::string &name, const std::string &value)
      {
        body += (body.empty() ? "\n" : ",\n") + indent + "  " + quoted(name) +
                ": " + value;
        return *this;
      }

      std::string
      str() const
      {
        return "{" + body + "\n" + indent + "}";
      }

    private:
      static std::string
      quoted(const std::string &text)
      {
        std::string result = "\"";
        for (const char c : text)
          if (c == '"' || c == '\\')
            result += std::string("\\") + c;
          else if (static_cast<unsigned char>(c) < 0x20)
            {
              char code[7];
              std::snprintf(code, sizeof(code), "\\u%04x", c);
              result += code;
            }
          else
            result += c;
        return result + "\"";
      }

      std::string indent;
      std::string body;
    };

    std::string
    model_json(const ModelSize &model)
    {
      return JsonObject(1)
        .member("fibers", model.fibers)
        .member("nodes", model.nodes)
        .member("fiber_elements", model.fiber_elements)
        .member("fiber_dofs", model.fiber_dofs)
        .member("matrix_cells", model.matrix_cells)
        .member("matrix_dofs", model.matrix_dofs)
        .member("contact_elements", model.contact_elements)
        .member("junctions", model.junctions)
        .str();
    }

    /** Three rows of three. */
    std::string
    matrix_json(const std::vector<double> &values)
    {
      std::string text = "[";
      for (unsigned int i = 0; i < 9; ++i)
        text += (i == 0     ? "[" :
                 i % 3 == 0 ? "], [" :
                              ", ") +
                table_cell(values.at(i));
      return text + "]]";
    }

    /** Energies of the cycles of a way, two legs each, of which the second
     * leads back to where the first began. */
    void
    add_cycles(const std::vector<TurningPoint> &turning_points,
               JsonObject                      &object)
    {
      std::vector<std::string> lost, friction, stored;
      for (unsigned int i = 2; i < turning_points.size(); ++i)
        {
          const TurningPoint &from = turning_points[i - 2],
                             &to   = turning_points[i];
          if (from.part != to.part)
            continue;
          lost.push_back(number_json(to.work - from.work));
          friction.push_back(number_json(to.friction - from.friction));
          stored.push_back(number_json(to.stored - from.stored));
          ++i;
        }
      if (lost.empty())
        return;
      object.raw("energy_lost_per_cycle[mJ]", list_json(lost))
        .raw("friction_loss_per_cycle[mJ]", list_json(friction))
        .raw("change_of_stored_energy_per_cycle[mJ]", list_json(stored));
    }

    std::string
    stage_json(const StageStatistics &stage)
    {
      const std::string seconds =
        JsonObject(3)
          .member("detection", stage.seconds.detection)
          .member("assembly", stage.seconds.assembly)
          .member("linear_solver", stage.seconds.linear_solver)
          .member("analysis", stage.seconds.analysis)
          .member("factorization", stage.seconds.factorization)
          .member("krylov", stage.seconds.krylov)
          .member("output", stage.seconds.output)
          .member("coarse", stage.seconds.coarse)
          .member("estimate", stage.seconds.estimate)
          .str();
      const std::string error =
        JsonObject(3)
          .member("mesh", stage.estimated_error.mesh)
          .member("stations", stage.estimated_error.stations)
          .member("penetration", stage.estimated_error.penetration)
          .member("matrix", stage.estimated_error.matrix)
          .member("tolerance", stage.estimated_error.tolerance)
          .member("total", stage.estimated_error.total)
          .str();
      JsonObject object(2);
      object.member("name", stage.name)
        .member("converged", stage.converged)
        .member("increments", stage.increments)
        .member("rejected_increments", stage.rejected_increments)
        .member("contact_updates", stage.contact_updates)
        .member("normal_updates", stage.normal_updates)
        .member("newton_iterations", stage.newton_iterations)
        .member("coarse_iterations", stage.coarse_iterations)
        .member("linear_iterations", stage.linear_iterations)
        .member("factorizations", stage.factorizations)
        .member("unsymmetric_systems", stage.unsymmetric_systems)
        .member("searches", stage.searches)
        .member("friction_history", stage.friction_history)
        .member("exchanged_values", stage.exchanged_values)
        .member("wall_seconds", stage.seconds.wall)
        .raw("seconds", seconds)
        .member("largest_penetration_over_radius",
                stage.largest_penetration_over_radius)
        .member("largest_section_change", stage.largest_section_change)
        .member("elastic_energy_N_mm", stage.elastic_energy)
        .member("negative_pivots", stage.negative_pivots)
        .raw("estimated_error", error)
        .member("crossings_out_of_order", stage.crossings_out_of_order)
        .member("contact_elements", stage.contact_elements)
        .member("broken", stage.broken);
      if (!stage.membrane_stiffness.empty())
        object.raw("membrane_stiffness_N_per_mm",
                   matrix_json(stage.membrane_stiffness));
      add_cycles(stage.turning_points, object);
      return object.str();
    }

    std::string
    stages_json(const std::vector<StageStatistics> &stages)
    {
      std::string list;
      for (const StageStatistics &stage : stages)
        list += (list.empty() ? "\n    " : ",\n    ") + stage_json(stage);
      return "[" + list + (list.empty() ? "]" : "\n  ]");
    }
  } // namespace



  std::string
  summary_json(const Summary &summary)
  {
    JsonObject json(0);
    json.member("program", std::string("fiberloom"))
      .member("version", summary.version)
      .member("revision", summary.revision)
      .member("run", summary.run)
      .member("ranks", summary.ranks)
      .member("converged", summary.converged)
      .raw("model", model_json(summary.model))
      .raw("stages", stages_json(summary.stages));
    if (!summary.fabric.empty())
      {
        JsonObject fabric(1);
        for (const auto &[name, value] : summary.fabric)
          fabric.member(name, value);
        json.raw("fabric", fabric.str());
      }
    return json.member("peak_memory_bytes", summary.peak_memory_bytes).str() +
           "\n";
  }



  double
  peak_memory_bytes(const MPI_Comm comm)
  {
    dealii::Utilities::System::MemoryStats memory;
    dealii::Utilities::System::get_memory_stats(memory);
    return dealii::Utilities::MPI::sum(1024. * memory.VmHWM, comm);
  }
} // namespace fiberloom
