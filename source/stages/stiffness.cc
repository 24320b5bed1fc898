// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/parameters.h>

#include <fiberloom/stages/cell.h>
#include <fiberloom/stages/stiffness.h>

namespace fiberloom
{
  Supports
  Stiffness::supports(const DofVector &) const
  {
    return Cell::supports(scene, 0);
  }



  void
  Stiffness::begin(State &state) const
  {
    Cell::place(state);
  }



  std::vector<BodyTarget>
  Stiffness::targets(const std::vector<Placement> &start, const double) const
  {
    return {{start[Cell::body]}};
  }



  ContactRule
  Stiffness::rule(const double) const
  {
    ContactRule rule;
    rule.friction = scene.parameters.contact.friction_coefficient > 0;
    return rule;
  }



  double
  Stiffness::first_step(const State &) const
  {
    return 1;
  }



  CurveRow
  Stiffness::curve(const State &, const std::vector<BodyVector> &) const
  {
    return {};
  }
} // namespace fiberloom
