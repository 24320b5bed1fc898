// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/fabric/fiber_density.h>

namespace fiberloom
{
  namespace
  {
    constexpr double glass_density   = 2.55e-9; // [t/mm^3]
    constexpr double glass_moduli[2] = {65000, 95000};
  } // namespace



  std::optional<double>
  known_density(const Fiber &fiber)
  {
    if (fiber.density > 0)
      return fiber.density;
    if (fiber.young_modulus >= glass_moduli[0] &&
        fiber.young_modulus <= glass_moduli[1])
      return glass_density;
    return {};
  }
} // namespace fiberloom
