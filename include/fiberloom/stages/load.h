// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_stages_load_h
#define fiberloom_stages_load_h

#include <fiberloom/stages/stage.h>

#include <memory>
#include <vector>

namespace fiberloom
{
  class DriveFunctions;

  /**
   * Moves and loads fiber ends as the scene's drives say: each drive is a
   * rigid body that holds some ends, whose six dofs follow functions of the
   * load or are free under a dead force and moment.
   */
  class Load : public Stage
  {
  public:
    explicit Load(const Scene &scene);
    ~Load() override;

    Supports
    supports() const override;

    void
    begin(State &state, Equilibrium &equilibrium) const override;

    std::vector<BodyTarget>
    targets(const std::vector<Placement> &start,
            const double                  load) const override;

    ContactRule
    rule(const double load) const override;

    double
    first_step(const State &state) const override;

    double
    largest_step() const override;

    CurveRow
    curve(const State                   &state,
          const std::vector<BodyVector> &reactions) const override;

  private:
    std::vector<std::vector<unsigned int>>       held_nodes; // by drive
    std::vector<std::unique_ptr<DriveFunctions>> functions;
  };
} // namespace fiberloom

#endif
