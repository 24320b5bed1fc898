// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_stages_coat_settings_h
#define fiberloom_stages_coat_settings_h

#include <fiberloom/base/stage_type.h>

#include <fiberloom/matrix/matrix_parameters.h>

namespace fiberloom
{
  /** Section Matrix of the parameter file. */
  struct CoatSettings : public CopyableSettings<CoatSettings>
  {
    static constexpr const char *stage = "coat";

    MatrixParameters matrix;

    void
    declare(ParameterCatalogue &catalogue) override;

    /** Lengths follow from the fibers, cells from the tows. */
    void
    resolve(const Parameters &parameters) override;

    void
    check(const Parameters &parameters) const override;

    /** A note where the modulus is one that no matrix has. */
    std::vector<std::string>
    notes(const Parameters &parameters) const override;

    bool
    describes_matrix() const override
    {
      return matrix.layers != Layers::none;
    }
  };

  /** The parameters of the matrix that a scene asks for. */
  const MatrixParameters &
  matrix_of(const Parameters &parameters);
} // namespace fiberloom

#endif
