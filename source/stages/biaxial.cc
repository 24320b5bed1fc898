// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/parameters.h>

#include <fiberloom/stages/biaxial.h>
#include <fiberloom/stages/cell.h>

namespace fiberloom
{
  Biaxial::Biaxial(const Scene &scene)
    : Stage(scene)
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
    return scene.fibers.cell ? Cell::supports(scene, free) :
                               TowEnds::supports(scene, false);
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
    const auto draw = [&](auto position) {
      position.x() *=
        1 - load_step * warp_strain / (1 + state.load * warp_strain);
      position.y() *=
        1 - load_step * fill_strain / (1 + state.load * fill_strain);
    };
    Past past{state.q, state.placements, state.load - load_step};
    for (unsigned int n = 0; n < scene.mesh.n_nodes(); ++n)
      draw(past.q.segment<3>(9 * n));
    for (Eigen::Index i = 9 * scene.mesh.n_nodes(); i < past.q.size(); i += 3)
      draw(past.q.segment<3>(i));
    if (scene.fibers.cell)
      past.placements[Cell::body] = Cell::strained(
        scene,
        state.placements[Cell::body],
        -load_step * warp_strain / (1 + state.load * warp_strain),
        -load_step * fill_strain / (1 + state.load * fill_strain));
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
                                                       load * warp_strain,
                                                       load * fill_strain);
        return targets;
      }
    for (unsigned int b = 0; b < start.size(); ++b)
      {
        targets[b].placement = start[b];
        targets[b].placement.position.x() *= 1 + load * warp_strain;
        targets[b].placement.position.y() *= 1 + load * fill_strain;
      }
    return targets;
  }



  double
  Biaxial::first_step(const State &) const
  {
    return scene.parameters.biaxial.first_step;
  }



  double
  Biaxial::largest_step() const
  {
    return scene.parameters.biaxial.largest_step;
  }



  CurveRow
  Biaxial::curve(const State                   &state,
                 const std::vector<BodyVector> &reactions) const
  {
    double strains[2] = {state.load * warp_strain, state.load * fill_strain};
    for (unsigned int d = 0; d < 2; ++d)
      if (free[d])
        strains[d] =
          Cell::periods(scene, state.placements[Cell::body])[d] /
            Cell::periods(scene, state.stage_start_placements[Cell::body])[d] -
          1;
    return {
      {"strain_warp", strains[0]},
      {"strain_fill", strains[1]},
      {"force_warp[N]", TowEnds::pull(scene, Tow::Family::warp, reactions)},
      {"force_fill[N]", TowEnds::pull(scene, Tow::Family::fill, reactions)}};
  }
} // namespace fiberloom
