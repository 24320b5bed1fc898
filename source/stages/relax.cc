// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/parameters.h>

#include <fiberloom/stages/relax.h>

#include <algorithm>

namespace fiberloom
{
  StageType
  Relax::type()
  {
    StageType type{"relax",
                   "lets the fabric come to rest",
                   StageType::Sample::fabric,
                   &make<Relax>,
                   {}};
    type.only_relaxes = true;
    return type;
  }



  Supports
  Relax::supports(const DofVector &) const
  {
    return TowEnds::supports(scene, 3);
  }



  void
  Relax::begin(State &state) const
  {
    TowEnds::place(scene, MatrixBorders::Grip::none, state);
  }



  std::vector<BodyTarget>
  Relax::targets(const std::vector<Placement> &start, const double) const
  {
    std::vector<BodyTarget> targets(start.size());
    for (unsigned int b = 0; b < start.size(); ++b)
      targets[b].placement = start[b];
    return targets;
  }



  double
  Relax::first_step(const State &) const
  {
    return 1;
  }



  CurveRow
  Relax::curve(const State &state, const std::vector<BodyVector> &) const
  {
    const auto &lines = scene.mesh.lines();
    double      low = 1e300, high = -1e300;
    for (const auto &line : lines)
      for (unsigned int n = line.first_node;
           n < line.first_node + line.n_nodes();
           ++n)
        {
          low  = std::min(low, state.q[9 * n + 2] - line.radius);
          high = std::max(high, state.q[9 * n + 2] + line.radius);
        }
    return {{{"thickness", Quantity::length}, high - low}};
  }
} // namespace fiberloom
