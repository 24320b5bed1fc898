// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_fabric_fiber_density_h
#define fiberloom_fabric_fiber_density_h

#include <fiberloom/fabric/fiber_set.h>

#include <optional>

namespace fiberloom
{
  /**
   * The density that is given [t/mm^3], else that of glass where the modulus is
   * that of glass, from 65 to 95 GPa; none for other fibers.
   */
  std::optional<double>
  known_density(const Fiber &fiber);
} // namespace fiberloom

#endif
