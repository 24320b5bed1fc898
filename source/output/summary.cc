// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/output/summary.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <Eigen/LU>

#include <nlohmann/json.hpp>

#include <cstdint>

namespace fiberloom
{
  namespace
  {
    /** Members stay in their order. */
    using Json = nlohmann::ordered_json;

    Json
    model_json(const ModelSize &model)
    {
      return {{"fibers", model.fibers},
              {"nodes", model.nodes},
              {"fiber_elements", model.fiber_elements},
              {"fiber_dofs", model.fiber_dofs},
              {"matrix_cells", model.matrix_cells},
              {"matrix_dofs", model.matrix_dofs},
              {"contact_elements", model.contact_elements},
              {"junctions", model.junctions}};
    }

    Json
    seconds_json(const Seconds &seconds)
    {
      return {{"detection", seconds.detection},
              {"assembly", seconds.assembly},
              {"linear_solver", seconds.linear_solver},
              {"analysis", seconds.analysis},
              {"factorization", seconds.factorization},
              {"krylov", seconds.krylov},
              {"output", seconds.output},
              {"coarse", seconds.coarse},
              {"estimate", seconds.estimate}};
    }

    Json
    constants_json(const StageStatistics &stage)
    {
      const Eigen::Matrix3d compliance =
        stage.filled_thickness *
        Eigen::Map<const Eigen::Matrix3d>(stage.membrane_stiffness.data())
          .inverse();
      return {{"thickness_mm", stage.filled_thickness},
              {"young_modulus_warp_MPa", 1 / compliance(0, 0)},
              {"young_modulus_fill_MPa", 1 / compliance(1, 1)},
              {"poisson_ratio_warp_fill", -compliance(0, 1) / compliance(0, 0)},
              {"shear_modulus_MPa", 1 / compliance(2, 2)}};
    }

    Json
    error_json(const ErrorEstimate &error)
    {
      return {{"mesh", error.mesh},
              {"stations", error.stations},
              {"penetration", error.penetration},
              {"matrix", error.matrix},
              {"tolerance", error.tolerance},
              {"total", error.total}};
    }

    /** Energies of the cycles of a way, two legs each, of which the second
     * leads back to where the first began. */
    void
    add_cycles(const std::vector<TurningPoint> &turning_points, Json &json)
    {
      for (unsigned int i = 2; i < turning_points.size(); ++i)
        {
          const TurningPoint &from = turning_points[i - 2],
                             &to   = turning_points[i];
          if (from.part != to.part)
            continue;
          json["energy_lost_per_cycle[mJ]"].push_back(to.work - from.work);
          json["friction_loss_per_cycle[mJ]"].push_back(to.friction -
                                                        from.friction);
          json["change_of_stored_energy_per_cycle[mJ]"].push_back(to.stored -
                                                                  from.stored);
          ++i;
        }
    }

    Json
    stage_json(const StageStatistics &stage)
    {
      Json                       json      = {{"name", stage.name},
                                              {"converged", stage.converged},
                                              {"increments", stage.increments},
                                              {"rejected_increments", stage.rejected_increments},
                                              {"contact_updates", stage.contact_updates},
                                              {"normal_updates", stage.normal_updates},
                                              {"newton_iterations", stage.newton_iterations},
                                              {"coarse_iterations", stage.coarse_iterations},
                                              {"linear_iterations", stage.linear_iterations},
                                              {"factorizations", stage.factorizations},
                                              {"unsymmetric_systems", stage.unsymmetric_systems},
                                              {"searches", stage.searches},
                                              {"friction_history", stage.friction_history},
                                              {"exchanged_values", stage.exchanged_values},
                                              {"wall_seconds", stage.seconds.wall},
                                              {"seconds", seconds_json(stage.seconds)},
                                              {"largest_penetration_over_radius",
                                               stage.largest_penetration_over_radius},
                                              {"largest_section_change", stage.largest_section_change},
                                              {"elastic_energy_N_mm", stage.elastic_energy},
                                              {"negative_pivots", stage.negative_pivots},
                                              {"estimated_error", error_json(stage.estimated_error)},
                                              {"crossings_out_of_order", stage.crossings_out_of_order},
                                              {"contact_elements", stage.contact_elements},
                                              {"broken", stage.broken}};
      const std::vector<double> &stiffness = stage.membrane_stiffness;
      for (std::size_t row = 0; row < stiffness.size(); row += 3)
        json["membrane_stiffness_N_per_mm"].push_back(
          {stiffness[row], stiffness[row + 1], stiffness[row + 2]});
      if (stage.filled_thickness > 0)
        json["engineering_constants"] = constants_json(stage);
      add_cycles(stage.turning_points, json);
      return json;
    }
  } // namespace



  std::string
  summary_json(const Summary &summary)
  {
    Json json = {{"program", "fiberloom"},
                 {"version", summary.version},
                 {"revision", summary.revision},
                 {"run", summary.run},
                 {"ranks", summary.ranks},
                 {"preview", summary.preview},
                 {"converged", summary.converged && !summary.preview},
                 {"model", model_json(summary.model)},
                 {"stages", Json::array()}};
    for (const StageStatistics &stage : summary.stages)
      {
        json["stages"].push_back(stage_json(stage));
        if (summary.preview)
          json["stages"].back()["converged"] = false;
      }
    for (const auto &[name, value] : summary.fabric)
      json["fabric"][name] = value;
    json["peak_memory_bytes"] =
      static_cast<std::uint64_t>(summary.peak_memory_bytes);
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  }



  double
  peak_memory_bytes(const MPI_Comm comm)
  {
    dealii::Utilities::System::MemoryStats memory;
    dealii::Utilities::System::get_memory_stats(memory);
    return dealii::Utilities::MPI::sum(1024. * memory.VmHWM, comm);
  }
} // namespace fiberloom
