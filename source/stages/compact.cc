// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/parameter_catalogue.h>
#include <fiberloom/base/parameters.h>

#include <fiberloom/matrix/layer_geometry.h>

#include <fiberloom/stages/cell.h>
#include <fiberloom/stages/compact.h>
#include <fiberloom/stages/ply_stack.h>

#include <algorithm>
#include <cmath>

namespace fiberloom
{
  namespace
  {
    constexpr unsigned int plates = Cell::body + 1; // their body

    // As stiff as the fiber's own section.
    constexpr double plate_stiffness = M_PI_4;

    // Of an element: crests are to be seen wherever they lie.
    constexpr unsigned int least_stations = 4;

    // The middle of plates that nothing touches stays where it is.
    constexpr double middle_spring = 1e-6;

    // A pressure begins with this part of it: where nothing presses, plates can
    // be anywhere.
    constexpr double least_pressure = .01;

    Way
    way_of(const CompactParameters &parameters)
    {
      std::vector<double> turning_points = parameters.way;
      if (parameters.return_way && turning_points.back() != 0)
        turning_points.push_back(0);
      return Way(turning_points);
    }
  } // namespace



  Compact::Compact(const Scene &scene)
    : Stage(scene)
    , parameters(scene.parameters.compact)
    , turning(way_of(scene.parameters.compact))
    , fiber_volume(0)
  {
    for (const auto &line : scene.mesh.lines())
      fiber_volume += M_PI * line.radius * line.radius * line.length;
  }



  Supports
  Compact::supports(const DofVector &) const
  {
    // What lies on the lowest ply is held by contact.
    Supports  supports = Cell::supports(scene, 0, false, 1);
    RigidBody body;
    body.name = "plates";
    body.prescribed.reset(2);
    if (parameters.pressure > 0)
      body.prescribed.reset(0);
    supports.bodies.push_back(body);
    const ContactParameters &contact = scene.parameters.contact;
    supports.plates                  = Plates{plates,
                             plate_stiffness,
                             contact.largest_penetration / 4,
                             middle_spring,
                             std::max(least_stations,
                                      static_cast<unsigned int>(std::lround(
                                        2 * contact.stations_per_element))),
                             plate_friction(),
                             contact.elastic_slip};
    return supports;
  }



  void
  Compact::begin(State &state) const
  {
    Cell::place(state);
    // So deep that plies and both plates are held by what they touch.
    close_stack(scene,
                Cell::plane_periods(scene, state.placements[Cell::body]),
                first_depth(),
                state.q);
    const Extent extent = skin_extent(scene.mesh, state.q);
    const double low = extent.low[2], high = extent.high[2];
    // The spring that holds the middle has its rest at 0.
    for (unsigned int n = 0; n < scene.mesh.n_nodes(); ++n)
      state.q[9 * n + 2] -= .5 * (low + high);
    Placement placement;
    placement.position = {high - low - 2 * first_depth(), 0, 0};
    state.placements.push_back(placement);
    state.contact.plates.clear();
    if (last_distance(state.placements) >= placement.position[0])
      throw StageFailure("stage compact: the fabric is " +
                         exact_text(high - low) +
                         " mm thick, which is thinner than it is to become");
  }



  void
  Compact::unload(State &state) const
  {
    state.placements[plates].position[0] += 2 * first_depth();
  }



  double
  Compact::plate_friction() const
  {
    return parameters.friction_coefficient < 0 ?
             scene.parameters.contact.friction_coefficient :
             parameters.friction_coefficient;
  }



  double
  Compact::first_depth() const
  {
    return .5 * scene.parameters.contact.largest_penetration *
           scene.mesh.smallest_radius();
  }



  double
  Compact::area(const std::vector<Placement> &placements) const
  {
    return Cell::area(scene, placements[Cell::body]);
  }



  double
  Compact::last_distance(const std::vector<Placement> &start) const
  {
    return parameters.volume_fraction > 0 ?
             fiber_volume / (area(start) * parameters.volume_fraction) :
             parameters.thickness;
  }



  Past
  Compact::guess(const State &state, const double load_step) const
  {
    // As if all had been pressed together evenly until now.
    Past past{state.q, state.placements, state.load - load_step};
    if (parameters.pressure > 0)
      return {};
    const double start = state.stage_start_placements[plates].position[0],
                 end   = last_distance(state.stage_start_placements),
                 now   = state.placements[plates].position[0],
                 next =
                   start + turning.at(state.load + load_step) * (end - start);
    const double middle = state.placements[plates].position[2];
    const double ratio  = (2 * now - next) / now;
    for (unsigned int n = 0; n < scene.mesh.n_nodes(); ++n)
      past.q[9 * n + 2] = middle + ratio * (past.q[9 * n + 2] - middle);
    past.placements[plates].position[0] *= ratio;
    return past;
  }



  std::vector<BodyTarget>
  Compact::targets(const std::vector<Placement> &start, const double load) const
  {
    std::vector<BodyTarget> targets;
    for (const Placement &placement : start)
      targets.push_back({placement});
    if (parameters.pressure > 0)
      targets[plates].load[0] = -parameters.pressure * area(start) *
                                std::max(least_pressure, turning.at(load));
    else
      targets[plates].placement.position[0] +=
        turning.at(load) * (last_distance(start) - start[plates].position[0]);
    return targets;
  }



  ContactRule
  Compact::rule(const double load) const
  {
    ContactRule rule = Stage::rule(load);
    rule.friction    = rule.friction || plate_friction() > 0;
    return rule;
  }



  double
  Compact::first_step(const State &) const
  {
    return parameters.first_step / turning.length();
  }



  double
  Compact::largest_step() const
  {
    return parameters.largest_step / turning.length();
  }



  CurveRow
  Compact::curve(const State                   &state,
                 const std::vector<BodyVector> &reactions) const
  {
    const double distance = state.placements[plates].position[0],
                 area     = this->area(state.placements);
    return {{"thickness[mm]", distance},
            {"pressure[MPa]", -reactions[plates][0] / area},
            {"fiber_volume_fraction", fiber_volume / (area * distance)}};
  }
} // namespace fiberloom
