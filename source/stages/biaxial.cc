// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/parameter_catalogue.h>
#include <fiberloom/base/parameters.h>

#include <fiberloom/stages/biaxial.h>
#include <fiberloom/stages/cell.h>

#include <algorithm>

namespace fiberloom
{
  void
  BiaxialSettings::declare(ParameterCatalogue &catalogue)
  {
    catalogue.enter_section("Biaxial");
    catalogue.add("Largest strain",
                  largest_strain,
                  "Elongation of the sample in the leading direction at the "
                  "end of the test, or where Way is 1, over its length.",
                  Allowed::from_to(1e-9, 1));
    catalogue.add("Strain ratio",
                  strain_ratio,
                  "Strain of the other direction over that of the leading "
                  "one; 0 holds the other direction.",
                  Allowed::any_number());
    catalogue.add("Leading direction",
                  leading_direction,
                  "Direction that takes the largest strain.");
    catalogue.add("Other direction",
                  other_direction,
                  "Whether the other direction is strained by the ratio, or "
                  "free: its tow ends move along their tows without force, "
                  "in a periodic cell there is no mean stress along it.");
    catalogue.add("First step",
                  first_step,
                  "First increment, and that of each leg of Way, over the "
                  "largest strain; never more than the largest step.",
                  Allowed::from_to(1e-6, 1));
    catalogue.add("Largest step",
                  largest_step,
                  "Largest increment, over the largest strain.",
                  Allowed::from_to(1e-6, 1));
    Way::declare(catalogue, way, "the largest strain", -1);
    catalogue.leave_section();
  }



  void
  BiaxialSettings::resolve(const Parameters &)
  {
    first_step = std::min(first_step, largest_step);
  }



  void
  BiaxialSettings::check(const Parameters &parameters) const
  {
    const std::string where = parameters.where("Biaxial/Way");
    Way::check(way, where);
    for (const double part : way)
      for (const double ratio : {1., strain_ratio})
        if (const double strain = part * ratio * largest_strain; strain <= -1)
          throw InputError(where + " = " + exact_text(way) +
                           ": a strain would be " + exact_text(strain) +
                           ", and nothing is left of the sample; allowed: "
                           "above -1");
  }



  StageType
  Biaxial::type()
  {
    return {"biaxial",
            "pulls in both directions",
            StageType::Sample::fabric,
            &make<Biaxial>,
            &make_settings<BiaxialSettings>};
  }



  Biaxial::Biaxial(const Scene &scene)
    : Stage(scene)
    , settings(scene.parameters.stage_settings.get<BiaxialSettings>())
    , turning(settings.way)
  {
    warp_strain = fill_strain = settings.largest_strain;
    const bool follows = settings.other_direction == OtherDirection::free;
    (settings.leading_direction == Direction::fill ? warp_strain :
                                                     fill_strain) *=
      follows ? 0 : settings.strain_ratio;
    if (follows)
      free.set(settings.leading_direction == Direction::fill ? 0 : 1);
  }



  Supports
  Biaxial::supports(const DofVector &) const
  {
    return scene.fibers.cell ? Cell::supports(scene, free.to_ulong()) :
                               TowEnds::supports(scene, free);
  }



  void
  Biaxial::begin(State &state) const
  {
    TowEnds::place(scene, MatrixBorders::Grip::across, state);
  }



  Past
  Biaxial::guess(const State &state, const double load_step) const
  {
    // As if all had been drawn out evenly until now.
    const double next       = state.load + load_step;
    const double along_warp = warp_strain_at(state.load) - warp_strain_at(next),
                 along_fill = fill_strain_at(state.load) - fill_strain_at(next),
                 warp_change = along_warp / (1 + warp_strain_at(state.load)),
                 fill_change = along_fill / (1 + fill_strain_at(state.load));
    const auto draw          = [&](auto position) {
      position.x() *= 1 + warp_change;
      position.y() *= 1 + fill_change;
    };
    Past past{state.q, state.placements, state.load - load_step};
    for (unsigned int n = 0; n < scene.mesh.n_nodes(); ++n)
      draw(past.q.segment<3>(9 * n));
    for (Eigen::Index i = 9 * scene.mesh.n_nodes(); i < past.q.size(); i += 3)
      draw(past.q.segment<3>(i));
    if (scene.fibers.cell)
      past.placements[Cell::body] = Cell::strained(scene,
                                                   state.placements[Cell::body],
                                                   warp_change,
                                                   fill_change);
    else
      for (Placement &placement : past.placements)
        draw(Eigen::Map<Vector3>(placement.position.data()));
    return past;
  }



  std::vector<BodyTarget>
  Biaxial::targets(const std::vector<Placement> &start, const double load) const
  {
    std::vector<BodyTarget> targets(start.size());
    if (scene.fibers.cell)
      {
        targets[Cell::body].placement = Cell::strained(scene,
                                                       start[Cell::body],
                                                       warp_strain_at(load),
                                                       fill_strain_at(load));
        return targets;
      }
    for (unsigned int b = 0; b < start.size(); ++b)
      {
        targets[b].placement = start[b];
        targets[b].placement.position.x() *= 1 + warp_strain_at(load);
        targets[b].placement.position.y() *= 1 + fill_strain_at(load);
      }
    return targets;
  }



  double
  Biaxial::first_step(const State &) const
  {
    return settings.first_step / turning.length();
  }



  double
  Biaxial::largest_step() const
  {
    return settings.largest_step / turning.length();
  }



  double
  Biaxial::free_strain(const unsigned int direction, const State &state) const
  {
    const auto length = [&](const std::vector<Placement> &placements) {
      if (scene.fibers.cell)
        return Cell::periods(scene, placements[Cell::body])[direction];
      double length = 0;
      for (unsigned int t = 0; t < scene.fibers.tows.size(); ++t)
        if (fiberloom::direction(scene.fibers.tows[t]) == direction)
          length += placements[TowEnds::body(t, 1)].position[direction] -
                    placements[TowEnds::body(t, 0)].position[direction];
      return length;
    };
    return length(state.placements) / length(state.stage_start_placements) - 1;
  }



  CurveRow
  Biaxial::curve(const State                   &state,
                 const std::vector<BodyVector> &reactions) const
  {
    double strains[2] = {warp_strain_at(state.load),
                         fill_strain_at(state.load)};
    for (unsigned int d = 0; d < 2; ++d)
      if (free[d])
        strains[d] = free_strain(d, state);
    constexpr auto warp = Tow::Family::warp, fill = Tow::Family::fill;
    return {
      {{"strain_warp", Quantity::strain, Role::deformation, warp}, strains[0]},
      {{"strain_fill", Quantity::strain, Role::deformation, fill}, strains[1]},
      {{"force_warp", Quantity::force, Role::response, warp},
       TowEnds::pull(scene, warp, reactions)},
      {{"force_fill", Quantity::force, Role::response, fill},
       TowEnds::pull(scene, fill, reactions)}};
  }
} // namespace fiberloom
