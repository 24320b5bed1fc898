// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_stages_biaxial_h
#define fiberloom_stages_biaxial_h

#include <fiberloom/base/choices.h>

#include <fiberloom/stages/tow_ends.h>

#include <bitset>

namespace fiberloom
{
  /** Section Biaxial of the parameter file. */
  struct BiaxialSettings : public CopyableSettings<BiaxialSettings>
  {
    double    largest_strain = 0.02;
    double    strain_ratio   = 1; // of the other direction over the leading one
    Direction leading_direction    = Direction::fill;
    OtherDirection other_direction = OtherDirection::strained;
    double         first_step      = 0.1; // of the largest strain
    double         largest_step    = 0.2; // of the largest strain

    std::vector<double> way = {1}; // parts of the largest strain

    void
    declare(ParameterCatalogue &catalogue) override;

    void
    resolve(const Parameters &parameters) override;

    void
    check(const Parameters &parameters) const override;
  };

  /**
   * Section 6.2 of the paper: the sample is stretched in warp and fill, every
   * tow end moving with the homogeneous deformation of the sample.
   */
  class Biaxial : public Stage
  {
  public:
    static StageType
    type();

    explicit Biaxial(const Scene &scene);

    Supports
    supports(const DofVector &start) const override;

    void
    begin(State &state) const override;

    Past
    guess(const State &state, const double load_step) const override;

    std::vector<BodyTarget>
    targets(const std::vector<Placement> &start,
            const double                  load) const override;

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
    double
    warp_strain_at(const double load) const
    {
      return turning.at(load) * warp_strain;
    }

    double
    fill_strain_at(const double load) const
    {
      return turning.at(load) * fill_strain;
    }

    /** Mean strain of the tows of a free direction, or that of the period. */
    double
    free_strain(const unsigned int direction, const State &state) const;

    const BiaxialSettings settings;
    const Way             turning;
    double                warp_strain, fill_strain; // the largest
    std::bitset<2>        free;                     // warp or fill
  };
} // namespace fiberloom

#endif
