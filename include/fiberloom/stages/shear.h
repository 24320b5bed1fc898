// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_stages_shear_h
#define fiberloom_stages_shear_h

#include <fiberloom/stages/angle_test.h>

namespace fiberloom
{
  /** Section Shear of the parameter file. */
  struct ShearSettings : public CopyableSettings<ShearSettings>
  {
    AngleSettings angle = {0.7};

    void
    declare(ParameterCatalogue &catalogue) override;

    void
    resolve(const Parameters &) override
    {
      angle.resolve();
    }

    void
    check(const Parameters &parameters) const override;

    bool
    keeps_right_angles() const override
    {
      return angle.way.back() == 0;
    }
  };

  /** Section 6.3 of the paper: a frame of four hinged bars of constant length
   * along the borders, warp and fill turning by half the angle each. The bars
   * of a periodic cell are its periods. */
  class Shear : public AngleTest
  {
  public:
    static StageType
    type();

    explicit Shear(const Scene &scene);

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
    /** Columns of the curve of a periodic cell, whose bars are its periods. */
    CurveRow
    cell_curve(const State                   &state,
               const std::vector<BodyVector> &reactions) const;
  };
} // namespace fiberloom

#endif
