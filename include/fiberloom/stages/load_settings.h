// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_stages_load_settings_h
#define fiberloom_stages_load_settings_h

#include <fiberloom/base/stage_type.h>

#include <cmath>
#include <string>

namespace fiberloom
{
  /** Section Load of the parameter file. t runs from 0 to @p end in that stage.
   * Drives are checked here as well. */
  struct LoadSettings : public CopyableSettings<LoadSettings>
  {
    double      end           = 1;
    double      first_step    = 1;         // of t
    double      largest_step  = 1;         // of t
    std::string line_load     = "0; 0; 0"; // [N/mm] functions of t
    std::string gravity       = "0; 0; 0"; // [mm/s^2] functions of t
    std::string loaded_fibers = "all";
    std::string probes; // points whose positions get columns

    /**
     * Angle by which an increment may turn a drive, so that turns are counted
     * [rad].
     */
    static constexpr double largest_turn = M_PI / 12;

    void
    declare(ParameterCatalogue &catalogue) override;

    void
    resolve(const Parameters &parameters) override;

    void
    check(const Parameters &parameters) const override;

    /** Points and fibers that entries name exist; no drive holds a point that
     * is held already. */
    void
    check_fibers(const Parameters &parameters,
                 const FiberSet   &fibers) const override;
  };
} // namespace fiberloom

#endif
