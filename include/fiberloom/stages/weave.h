// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_stages_weave_h
#define fiberloom_stages_weave_h

#include <fiberloom/base/choices.h>

#include <fiberloom/stages/tow_ends.h>

namespace fiberloom
{
  /** Section Weaving of the parameter file: how overlapping tows are moved
   * apart. */
  struct WeaveSettings : public CopyableSettings<WeaveSettings>
  {
    WeavingPath path = WeavingPath::automatic;
    double      step =
      0.5; // reduction of the allowed overlap per step over the radius
    unsigned int fast_iterations_per_step = 2;
    unsigned int coarser_meshes           = 2;
    double       near_enough = 0; // of a coarser mesh, see Problem; no entry

    void
    declare(ParameterCatalogue &catalogue) override;

    void
    resolve(const Parameters &parameters) override;

    void
    check(const Parameters &) const override
    {}
  };

  /**
   * Section 4.1 of the paper: from flat tows that interpenetrate, fibers of
   * crossing tows are moved past each other by contacts paired as seen from
   * above, on the sides that the superimposition order says, the overlap that
   * is allowed between them shrinking from the tows' thickness to nothing. Tow
   * ends are free along the tows.
   */
  class Weave : public Stage
  {
  public:
    static StageType
    type();

    explicit Weave(const Scene &scene);

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

    /**
     * A typical force at a crossing while tows still overlap [N], see
     * Stage::least_force_scale().
     */
    double
    least_force_scale(const double load) const override;

    /**
     * Weaves without friction: a few iterations for each overlap, with all of
     * contact regenerated in each, then straight to the standard normals.
     */
    bool
    take_fast_path(State       &state,
                   const State &before,
                   Equilibrium &equilibrium) const override;

    bool
    starts_coarsely() const override;

    /** Finds the minimum of the energy without friction, then with it. */
    bool
    settle(State       &state,
           const State &before,
           Equilibrium &equilibrium) const override;

    bool
    is_test() const override
    {
      return false;
    }

    CurveRow
    curve(const State                   &state,
          const std::vector<BodyVector> &reactions) const override;

  private:
    /** Whether the fast path is to be tried. */
    bool
    has_fast_path() const;

    bool
    weave_in_one_increment(State       &state,
                           const State &before,
                           Equilibrium &equilibrium) const;

    const WeaveSettings settings;

    double full_overlap; // [mm]
    double radius;       // [mm]
  };
} // namespace fiberloom

#endif
