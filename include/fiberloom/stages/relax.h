// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_stages_relax_h
#define fiberloom_stages_relax_h

#include <fiberloom/stages/tow_ends.h>

namespace fiberloom
{
  /**
   * From the woven state to equilibrium with contacts found by distance and
   * friction, tow ends free along the tows.
   */
  class Relax : public Stage
  {
  public:
    static StageType
    type();

    using Stage::Stage;

    Supports
    supports(const DofVector &start) const override;

    void
    begin(State &state) const override;

    std::vector<BodyTarget>
    targets(const std::vector<Placement> &start,
            const double                  load) const override;

    double
    first_step(const State &state) const override;

    bool
    is_test() const override
    {
      return false;
    }

    CurveRow
    curve(const State                   &state,
          const std::vector<BodyVector> &reactions) const override;
  };
} // namespace fiberloom

#endif
