// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/parameters.h>

#include <fiberloom/stages/biaxial.h>
#include <fiberloom/stages/cell.h>

namespace fiberloom
{
  Biaxial::Biaxial(const Scene &scene)
    : Stage(scene)
    , turning(scene.parameters.biaxial.way)
  {
    const BiaxialParameters &biaxial = scene.parameters.biaxial;
    warp_strain = fill_strain = biaxial.largest_strain;
    const bool follows        = biaxial.other_direction == "free";
    (biaxial.leading_direction == "fill" ? warp_strain : fill_strain) *=
      follows ? 0 : biaxial.strain_ratio;
    if (follows)
      free.set(biaxial.leading_direction == "fill" ? 0 : 1);
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
    return scene.parameters.biaxial.first_step / turning.length();
  }



  double
  Biaxial::largest_step() const
  {
    return scene.parameters.biaxial.largest_step / turning.length();
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
    return {
      {"strain_warp", strains[0]},
      {"strain_fill", strains[1]},
      {"force_warp[N]", TowEnds::pull(scene, Tow::Family::warp, reactions)},
      {"force_fill[N]", TowEnds::pull(scene, Tow::Family::fill, reactions)}};
  }
} // namespace fiberloom
