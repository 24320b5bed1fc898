// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_base_strength_parameters_h
#define fiberloom_base_strength_parameters_h

namespace fiberloom
{
  /** When fibers break; never, as they are here. */
  struct StrengthParameters
  {
    double       breaking_strain  = 0; // 0: by the strength
    double       strength         = 0; // [MPa], 0: by the breaking strain
    double       weibull_modulus  = 0; // 0: the same strength everywhere
    double       reference_length = 0; // [mm], of which it is the strength
    unsigned int seed             = 1;

    bool
    can_break() const
    {
      return breaking_strain > 0 || strength > 0;
    }
  };
} // namespace fiberloom

#endif
