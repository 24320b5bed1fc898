// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/parameter_catalogue.h>
#include <fiberloom/base/parameters.h>

#include <fiberloom/matrix/layer_geometry.h>

#include <fiberloom/stages/cell.h>
#include <fiberloom/stages/compact.h>
#include <fiberloom/stages/ply_stack.h>

#include <boost/format.hpp>

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
    way_of(const CompactSettings &settings)
    {
      std::vector<double> turning_points = settings.way;
      if (settings.return_way && turning_points.back() != 0)
        turning_points.push_back(0);
      return Way(turning_points);
    }
  } // namespace



  void
  CompactSettings::declare(ParameterCatalogue &catalogue)
  {
    catalogue.enter_section("Compact");
    catalogue.add("Thickness",
                  thickness,
                  "Distance of the plates at the end [mm]. One of this, "
                  "Fiber volume fraction and Pressure has to be given.",
                  Allowed::at_least(0));
    catalogue.add("Fiber volume fraction",
                  volume_fraction,
                  "Volume of the fibers over that between the plates at the "
                  "end.",
                  Allowed::from_to_below(0, 1));
    catalogue.add("Pressure",
                  pressure,
                  "Force on a plate over the area of the cell at the end "
                  "[MPa].",
                  Allowed::at_least(0));
    catalogue.add("Return",
                  return_way,
                  "Whether the plates go back to where they began, after Way.",
                  Allowed::true_or_false());
    catalogue.add("Friction coefficient",
                  friction_coefficient,
                  "Coulomb's coefficient between fibers and plates; 0: no "
                  "friction, negative: that between fibers.",
                  Allowed::at_least(-1));
    catalogue.add("First step",
                  first_step,
                  "First increment, and that of each leg of Way, over the "
                  "whole approach; never more than the largest step.",
                  Allowed::from_to(1e-6, 1));
    catalogue.add("Largest step",
                  largest_step,
                  "Largest increment, over the whole approach.",
                  Allowed::from_to(1e-6, 1));
    Way::declare(catalogue, way, "the whole approach", 0);
    catalogue.leave_section();
  }



  void
  CompactSettings::resolve(const Parameters &)
  {
    first_step = std::min(first_step, largest_step);
  }



  void
  CompactSettings::check(const Parameters &parameters) const
  {
    Way::check(way, parameters.where("Compact/Way"));
    if (!parameters.has_stage(stage))
      return;
    if ((thickness > 0) + (volume_fraction > 0) + (pressure > 0) != 1)
      throw InputError(parameters.where("Compact/Thickness") +
                       ", Fiber volume fraction and Pressure: one of them "
                       "says how far the plates go; allowed: one above 0");
    constexpr double packed = .9068996821171089; // pi / sqrt(12)
    const double     volume =
      parameters.fabric.volume_over_area() * parameters.fabric.plies;
    if (thickness > 0 && thickness <= volume / packed)
      throw InputError(parameters.where("Compact/Thickness") + " = " +
                       exact_text(thickness) +
                       ": round fibers cannot be packed to that; allowed: "
                       "above " +
                       exact_text(volume / packed));
    if (volume_fraction >= packed)
      throw InputError(parameters.where("Compact/Fiber volume fraction") +
                       " = " + exact_text(volume_fraction) +
                       ": more than round fibers can be packed to; allowed: "
                       "below " +
                       exact_text(packed));
  }



  std::vector<std::string>
  CompactSettings::notes(const Parameters &parameters) const
  {
    // A fiber of each tow lies between the plates where two tows cross.
    const FabricParameters &fabric = parameters.fabric;
    const double            two =
      2 * (fabric.warp.fiber_radius + fabric.fill.fiber_radius);
    const double volume = fabric.volume_over_area();
    const double fraction =
      thickness > 0 ? volume / thickness : volume_fraction;
    if (!parameters.is_fabric() || !parameters.has_stage(stage) ||
        fabric.plies > 1 || fraction * two <= volume)
      return {};
    return {parameters.where(thickness > 0 ? "Compact/Thickness" :
                                             "Compact/Fiber volume fraction") +
            (boost::format(
               ": plates are two fibers apart where tows cross in single "
               "layers, at a fraction of about %.2g and a thickness of %.12g "
               "mm; beyond that only sections give way, and pressures grow by "
               "orders of magnitude") %
             (volume / two) % two)
              .str()};
  }



  StageType
  Compact::type()
  {
    StageType type{CompactSettings::stage,
                   "presses a periodic cell between plates",
                   StageType::Sample::cell,
                   &make<Compact>,
                   &make_settings<CompactSettings>};
    type.needs_no_matrix = true;
    return type;
  }



  Compact::Compact(const Scene &scene)
    : Stage(scene)
    , settings(scene.parameters.stage_settings.get<CompactSettings>())
    , turning(way_of(settings))
    , fiber_volume(0)
  {
    for (const auto &line : scene.mesh.lines())
      fiber_volume += M_PI * line.radius * line.radius * line.length;
  }



  Supports
  Compact::supports(const DofVector &) const
  {
    // What lies on the lowest ply is held by contact.
    Supports  supports = Cell::supports(scene, 0, Cell::Spacing::free, 1);
    RigidBody body;
    body.name = "plates";
    body.prescribed.reset(2);
    if (settings.pressure > 0)
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
    return settings.friction_coefficient < 0 ?
             scene.parameters.contact.friction_coefficient :
             settings.friction_coefficient;
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
    return settings.volume_fraction > 0 ?
             fiber_volume / (area(start) * settings.volume_fraction) :
             settings.thickness;
  }



  Past
  Compact::guess(const State &state, const double load_step) const
  {
    // As if all had been pressed together evenly until now.
    Past past{state.q, state.placements, state.load - load_step};
    if (settings.pressure > 0)
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
    if (settings.pressure > 0)
      targets[plates].load[0] = -settings.pressure * area(start) *
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
    return settings.first_step / turning.length();
  }



  double
  Compact::largest_step() const
  {
    return settings.largest_step / turning.length();
  }



  CurveRow
  Compact::curve(const State                   &state,
                 const std::vector<BodyVector> &reactions) const
  {
    const double distance = state.placements[plates].position[0],
                 area     = this->area(state.placements);
    return {{{"thickness", Quantity::length}, distance},
            {{"pressure", Quantity::pressure, Role::response},
             -reactions[plates][0] / area},
            {{"fiber_volume_fraction", Quantity::fraction, Role::deformation},
             fiber_volume / (area * distance)}};
  }
} // namespace fiberloom
