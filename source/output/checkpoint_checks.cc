// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>

#include <fiberloom/output/checkpoint_checks.h>

#include <algorithm>
#include <cmath>

namespace fiberloom
{
  namespace
  {
    // Of lengths [mm], forces and stiffnesses that runs have, by far.
    constexpr double largest_number = 1e20, farthest_point = 1e7;

    // The shortest steps that are tried are 1e-5 of a stage.
    constexpr double shortest_step = 1e-12;

    constexpr unsigned int most_parts = 10000; // of a cell of stations

    void
    demand(const bool good, const std::string &what)
    {
      if (!good)
        throw InputError("holds " + what + " that cannot be");
    }

    bool
    is_within(const double value, const double low, const double high)
    {
      return value >= low && value <= high; // false for NaN
    }

    template <class Vector>
    bool
    is_near(const Vector &x)
    {
      return x.size() == 0 ||
             (x.allFinite() && x.cwiseAbs().maxCoeff() <= farthest_point);
    }

    /** Of stages, in files that are written. */
    bool
    is_name(const std::string &name)
    {
      return name.size() < 100 &&
             std::all_of(name.begin(), name.end(), [](const char c) {
               return (c >= 'a' && c <= 'z') || c == ' ' || c == '_';
             });
    }

    void
    check_placements(const std::vector<Placement> &placements)
    {
      for (const Placement &placement : placements)
        demand(is_near(placement.position) && is_near(placement.turn) &&
                 is_within(placement.rotation.norm(), 1 - 1e-6, 1 + 1e-6),
               "the place of a body");
    }

    /** Fibers of a pair, and parameters on them. */
    bool
    is_on_fibers(const std::array<unsigned int, 2> &fibers,
                 const std::array<double, 2>       &u,
                 const FiberMesh                   &mesh)
    {
      for (unsigned int s = 0; s < 2; ++s)
        if (fibers[s] >= mesh.lines().size() ||
            !is_within(u[s], -1, mesh.lines()[fibers[s]].n_elements + 1.))
          return false;
      return true;
    }

    /** Sorted lists are searched by halving. */
    void
    check_order(const ContactState &contact)
    {
      demand(std::is_sorted(contact.history.begin(),
                            contact.history.end(),
                            [](const auto &a, const auto &b) {
                              return a.fibers < b.fibers;
                            }) &&
               std::is_sorted(contact.plates.begin(),
                              contact.plates.end(),
                              [](const auto &a, const auto &b) {
                                return std::make_pair(a.fiber, a.u) <
                                       std::make_pair(b.fiber, b.u);
                              }),
             "an order of contacts");
    }

    void
    check_zones(const std::vector<ContactZone> &zones, const FiberMesh &mesh)
    {
      for (const ContactZone &zone : zones)
        {
          bool good = std::abs(zone.side) <= 1 && !zone.stiffness.empty() &&
                      std::is_sorted(zone.stiffness.begin(),
                                     zone.stiffness.end(),
                                     [](const auto &a, const auto &b) {
                                       return a.first < b.first;
                                     });
          for (const auto &[end, stiffness] : zone.stiffness)
            good = good && is_within(end, 0, largest_number) &&
                   is_within(stiffness, 0, largest_number);
          for (unsigned int end = 0; end < 2; ++end)
            good =
              good && is_on_fibers(zone.fibers,
                                   {{zone.range[0][end], zone.range[1][end]}},
                                   mesh);
          for (const auto &[cell, parts] : zone.divided)
            good = good && cell >= 0 && parts > 0 && parts <= most_parts;
          demand(good, "a zone of contact");
        }
      demand(std::is_sorted(zones.begin(),
                            zones.end(),
                            [](const auto &a, const auto &b) {
                              return a.fibers < b.fibers;
                            }),
             "an order of contacts");
    }

    void
    check_contact(const ContactState &contact, const FiberMesh &mesh)
    {
      check_zones(contact.zones, mesh);
      for (const FrictionHistory &entry : contact.history)
        demand(is_on_fibers(entry.fibers, entry.u, mesh) && is_near(entry.slip),
               "a slip of friction");
      for (const PlateHistory &entry : contact.plates)
        demand(is_on_fibers({{entry.fiber, entry.fiber}},
                            {{entry.u, entry.u}},
                            mesh) &&
                 is_near(Vector3(entry.slip[0], entry.slip[1], 0)),
               "a slip on a plate");
      check_order(contact);
    }

    void
    check_breaks(const FiberHistory &history, const FiberMesh &mesh)
    {
      for (const auto &[element, entry] : history.breaks)
        demand(element < mesh.n_elements() &&
                 entry.number < history.breaks.size() && is_name(entry.stage) &&
                 is_within(entry.load, 0, 1) &&
                 is_within(entry.strain, 0, largest_number) &&
                 is_near(entry.place),
               "a break of a fiber");
    }

    std::size_t
    n_vertices(const LayerBlock &block)
    {
      constexpr unsigned int most = 1000000; // cells along an edge
      double                 n    = 1;
      for (const unsigned int cells : block.n_cells)
        {
          demand(cells > 0 && cells < most, "a layer of matrix");
          n *= cells + 1.;
        }
      demand(3 * n == block.vertices.size(), "a layer of matrix");
      return n;
    }

    /** Of all layers, two of which share none. */
    void
    check_matrix_state(const MatrixState &matrix, const FiberMesh &mesh)
    {
      std::size_t n_cells = 0;
      for (const LayerBlock &block : matrix.layers.blocks)
        {
          n_vertices(block);
          for (const double x : block.vertices)
            demand(is_within(x, -farthest_point, farthest_point),
                   "a layer of matrix");
          demand(worst_corner(block) > 0, "a layer of matrix");
          n_cells +=
            std::size_t(block.n_cells[0]) * block.n_cells[1] * block.n_cells[2];
        }
      for (const Junction &junction : matrix.junctions)
        {
          bool good = junction.point.element < mesh.n_elements() &&
                      junction.place.cell < n_cells &&
                      is_within(junction.point.xi, -1.1, 1.1) &&
                      is_within(junction.stiffness, 0, largest_number);
          for (const double component : junction.particle)
            good = good && is_within(component, -1.1, 1.1);
          for (unsigned int i = 0; i < 3; ++i)
            good = good && is_within(junction.place.coordinates[i], -.1, 1.1);
          demand(good, "a junction");
        }
      demand(matrix.is_empty() || matrix.degree == 1 || matrix.degree == 2,
             "a degree of matrix");
    }

    std::size_t
    n_matrix_dofs(const MatrixState &matrix)
    {
      std::size_t n = 0;
      for (const LayerBlock &block : matrix.layers.blocks)
        n += 3 * (std::size_t(matrix.degree) * block.n_cells[0] + 1) *
             (matrix.degree * block.n_cells[1] + 1) *
             (matrix.degree * block.n_cells[2] + 1);
      return n;
    }

    void
    check_dofs(const State &state, const FiberMesh &mesh)
    {
      const std::size_t fibers = mesh.reference().size(),
                        all    = fibers + n_matrix_dofs(state.matrix);
      demand(std::size_t(state.q.size()) == all, "a number of unknowns");
      for (const DofVector *q : {&state.stage_start_q, &state.previous.q})
        {
          const std::size_t n = q->size();
          demand(n == 0 || n == fibers || n == all, "a number of unknowns");
        }
      demand(state.previous.q.size() == 0 ||
               state.previous.placements.size() == state.placements.size(),
             "a number of bodies");
      demand(state.coarse.q.size() == 0 ||
               state.coarse.q.size() == state.q.size(),
             "a number of unknowns");
      demand(is_near(state.q) && is_near(state.stage_start_q) &&
               is_near(state.previous.q) && is_near(state.coarse.q),
             "a position");
    }

    void
    check_progress(const State &state)
    {
      bool good =
        is_within(state.load, 0, 1) && is_within(state.previous.load, 0, 1) &&
        (state.step == 0 || is_within(state.step, shortest_step, 1)) &&
        is_within(state.dissipation, -largest_number, largest_number);
      for (const auto *names : {&state.stages_done, &state.scene_stages})
        good = good && std::all_of(names->begin(), names->end(), is_name);
      demand(good && state.stage <= state.scene_stages.size(),
             "a place within the stages");
    }

    void
    check_statistics(const StageStatistics &statistics)
    {
      const Seconds &s    = statistics.seconds;
      bool           good = is_name(statistics.name);
      for (const double value : {s.detection,
                                 s.assembly,
                                 s.linear_solver,
                                 s.analysis,
                                 s.factorization,
                                 s.krylov,
                                 s.output,
                                 s.yardstick,
                                 s.wall,
                                 s.estimate,
                                 statistics.largest_penetration_over_radius,
                                 statistics.largest_section_change,
                                 statistics.elastic_energy})
        good = good && is_within(value, -largest_number, largest_number);
      demand(good, "a record of a stage");
    }
  } // namespace



  void
  check_checkpoint(const Checkpoint &checkpoint, const FiberMesh &mesh)
  {
    const State &state = checkpoint.state;
    check_matrix_state(state.matrix, mesh);
    check_dofs(state, mesh);
    check_placements(state.placements);
    check_placements(state.stage_start_placements);
    check_placements(state.previous.placements);
    check_zones(state.stage_start_zones, mesh.with_images());
    check_contact(state.contact, mesh.with_images());
    check_placements(state.coarse.placements);
    check_contact(state.coarse.contact, mesh.with_images());
    check_breaks(state.fibers, mesh);
    check_progress(state);
    for (const StageStatistics &statistics : checkpoint.stages)
      check_statistics(statistics);
  }
} // namespace fiberloom
