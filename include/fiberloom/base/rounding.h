// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_base_rounding_h
#define fiberloom_base_rounding_h

namespace fiberloom
{
  /** Energies, forces and places that differ by less than this part of their
   * scale are the same: sums over a sample are rounded to no less. */
  constexpr double rounding = 1e-9;
} // namespace fiberloom

#endif
