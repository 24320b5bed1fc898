// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/parameters.h>

#include <fiberloom/stages/biaxial.h>

namespace fiberloom
{
  Biaxial::Biaxial(const Scene &scene)
    : Stage(scene)
  {
    const BiaxialParameters &biaxial = scene.parameters.biaxial;
    warp_strain = fill_strain = biaxial.largest_strain;
    (biaxial.leading_direction == "fill" ? warp_strain : fill_strain) *=
      biaxial.strain_ratio;
  }



  Supports
  Biaxial::supports(const DofVector &) const
  {
    return TowEnds::supports(scene, false);
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
    for (Placement &placement : past.placements)
      draw(Eigen::Map<Vector3>(placement.position.data()));
    return past;
  }



  std::vector<BodyTarget>
  Biaxial::targets(const std::vector<Placement> &start, const double load) const
  {
    std::vector<BodyTarget> targets(start.size());
    for (unsigned int b = 0; b < start.size(); ++b)
      {
        targets[b].placement = start[b];
        targets[b].placement.position.x() *= 1 + load * warp_strain;
        targets[b].placement.position.y() *= 1 + load * fill_strain;
      }
    return targets;
  }



  ContactRule
  Biaxial::rule(const double) const
  {
    ContactRule rule;
    rule.friction = scene.parameters.contact.friction_coefficient > 0;
    return rule;
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
    return {
      {"strain_warp", state.load * warp_strain},
      {"strain_fill", state.load * fill_strain},
      {"force_warp[N]", TowEnds::pull(scene, Tow::Family::warp, reactions)},
      {"force_fill[N]", TowEnds::pull(scene, Tow::Family::fill, reactions)}};
  }
} // namespace fiberloom
