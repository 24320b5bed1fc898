// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_stages_stiffness_h
#define fiberloom_stages_stiffness_h

#include <fiberloom/stages/stage.h>

namespace fiberloom
{
  /**
   * The tangent stiffness of a periodic cell as the stage before has left it:
   * the cell is held where it is, and what small strains would do is found from
   * the tangent there, see membrane_stiffness().
   */
  class Stiffness : public Stage
  {
  public:
    using Stage::Stage;

    Supports
    supports(const DofVector &start) const override;

    void
    begin(State &state) const override;

    std::vector<BodyTarget>
    targets(const std::vector<Placement> &start,
            const double                  load) const override;

    ContactRule
    rule(const double load) const override;

    double
    first_step(const State &state) const override;

    bool
    is_test() const override
    {
      return false;
    }

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
