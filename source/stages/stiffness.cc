// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/stages/cell.h>
#include <fiberloom/stages/stiffness.h>

namespace fiberloom
{
  StageType
  Stiffness::type()
  {
    return {"stiffness",
            "finds the tangent stiffness of a periodic cell",
            StageType::Sample::cell,
            &make<Stiffness>,
            {}};
  }



  Supports
  Stiffness::supports(const DofVector &) const
  {
    return Cell::supports(scene, 0);
  }



  CurveRow
  Stiffness::curve(const State &, const std::vector<BodyVector> &) const
  {
    return {};
  }
} // namespace fiberloom
