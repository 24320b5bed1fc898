// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_stages_bend_h
#define fiberloom_stages_bend_h

#include <fiberloom/base/choices.h>

#include <fiberloom/stages/angle_test.h>

namespace fiberloom
{
  /** Section Bending of the parameter file. */
  struct BendSettings : public CopyableSettings<BendSettings>
  {
    Direction     direction = Direction::warp;      // the one that is bent
    AngleSettings angle     = {1.5707963267948966}; // between the borders

    void
    declare(ParameterCatalogue &catalogue) override;

    void
    resolve(const Parameters &) override
    {
      angle.resolve();
    }

    void
    check(const Parameters &parameters) const override;
  };

  /**
   * Section 6.4 of the paper: two opposite borders turn by half the angle each,
   * against each other, about axes in the middle of the fabric whose distance
   * is that of the ends of an arc as long as the sample. The other borders are
   * free. Without a matrix they would come loose: there crossing tows end in
   * the planes of their borders and at right angles to them, as in a sample
   * that is much wider, and the ends of bent tows come nearer as no force
   * along the fabric asks.
   */
  class Bend : public AngleTest
  {
  public:
    static StageType
    type();

    explicit Bend(const Scene &scene);

    Supports
    supports(const DofVector &start) const override;

    CurveRow
    curve(const State                   &state,
          const std::vector<BodyVector> &reactions) const override;

  protected:
    Placement
    move(const std::vector<Placement> &start,
         const unsigned int            body,
         const double                  angle) const override;

    Vector3
    place(const std::vector<Placement> &begun,
          const Vector3                &start,
          const double                  angle) const override;

    Vector3
    spin(const Vector3 &start, const Direction along) const override;

  private:
    void
    hold_without_matrix(std::vector<RigidBody> &bodies) const;

    /** Middle of the tow ends on the border at side 0 or 1 [mm]. */
    Vector3
    border_center(const std::vector<Placement> &placements,
                  const unsigned int            side) const;

    bool
    is_bent(const unsigned int body) const
    {
      return border(body) / 2 == axis;
    }

    const unsigned int axis;   // 0: warp is bent, 1: fill
    double             length; // of the sample before weaving [mm]
  };
} // namespace fiberloom

#endif
