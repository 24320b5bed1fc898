// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_stages_compact_h
#define fiberloom_stages_compact_h

#include <fiberloom/stages/stage.h>

namespace fiberloom
{
  /** Section Compact of the parameter file. */
  struct CompactSettings : public CopyableSettings<CompactSettings>
  {
    static constexpr const char *stage = "compact";

    double thickness       = 0; // between the plates [mm]; one of these three
    double volume_fraction = 0; // of fibers between the plates
    double pressure        = 0; // on the plates [MPa]
    bool   return_way      = false;   // and back to where it began
    double friction_coefficient = -1; // of the plates; -1: the fibers' own
    double first_step           = .02;
    double largest_step         = .05;

    std::vector<double> way = {1}; // parts of that

    void
    declare(ParameterCatalogue &catalogue) override;

    void
    resolve(const Parameters &parameters) override;

    void
    check(const Parameters &parameters) const override;

    /**
     * A note where the plates do not come as near as asked for where tows
     * cross.
     */
    std::vector<std::string>
    notes(const Parameters &parameters) const override;
  };

  /**
   * A periodic cell between two rigid plates, which come
   * together until they are at a distance or are pressed by a pressure, and go
   * back where their way does. The periods stay.
   */
  class Compact : public Stage
  {
  public:
    static StageType
    type();

    explicit Compact(const Scene &scene);

    Supports
    supports(const DofVector &start) const override;

    /** Moves the fabric to the plates' middle, at the height 0. Throws
     * StageFailure where it is thinner already. */
    void
    begin(State &state) const override;

    /** Takes the plates to where they just touch the fabric. */
    void
    unload(State &state) const override;

    Past
    guess(const State &state, const double load_step) const override;

    std::vector<BodyTarget>
    targets(const std::vector<Placement> &start,
            const double                  load) const override;

    ContactRule
    rule(const double load) const override;

    double
    first_step(const State &state) const override;

    double
    largest_step() const override;

    const Way *
    way() const override
    {
      return &turning;
    }

    CurveRow
    curve(const State                   &state,
          const std::vector<BodyVector> &reactions) const override;

  private:
    /** How deep a plate presses into the fabric where the stage begins [mm]. */
    double
    first_depth() const;

    /** Coefficient of friction between fibers and plates. */
    double
    plate_friction() const;

    /** Area of the cell in the plane [mm^2]. */
    double
    area(const std::vector<Placement> &placements) const;

    /**
     * Distance of the plates at the end [mm]; 0 where a pressure is asked for.
     */
    double
    last_distance(const std::vector<Placement> &start) const;

    const CompactSettings settings;
    const Way             turning;
    double                fiber_volume; // [mm^3]
  };
} // namespace fiberloom

#endif
