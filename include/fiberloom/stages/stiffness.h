// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_stages_stiffness_h
#define fiberloom_stages_stiffness_h

#include <fiberloom/stages/relax.h>

namespace fiberloom
{
  /**
   * The tangent stiffness of a periodic cell as the stage before has left it:
   * the cell is held where it is, and what small strains would do is found from
   * the tangent there, see membrane_stiffness().
   */
  class Stiffness : public Relax
  {
  public:
    static StageType
    type();

    using Relax::Relax;

    Supports
    supports(const DofVector &start) const override;

    bool
    finds_stiffness() const override
    {
      return true;
    }

    CurveRow
    curve(const State                   &state,
          const std::vector<BodyVector> &reactions) const override;
  };
} // namespace fiberloom

#endif
