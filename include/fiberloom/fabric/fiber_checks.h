// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_fabric_fiber_checks_h
#define fiberloom_fabric_fiber_checks_h

#include <fiberloom/fabric/fiber_set.h>

#include <string>

namespace fiberloom
{
  /** Throws InputError for what is not finite or further than any sample. */
  void
  check_place(const Vector3 &point, const std::string &name);

  /**
   * Throws InputError when the radius is longer than the fiber, or so small,
   * and when the place or the modulus is so large, that computing with them
   * makes no sense.
   */
  void
  check_proportions(const Fiber &fiber);

  /**
   * Throws InputError when a bend between two nodes is narrower than the
   * radius of the fiber.
   */
  void
  check_bends(const Fiber &fiber);

  /**
   * Throws InputError when the axes of two fibers are closer than a tenth of
   * the smaller radius along more than a diameter, or along a whole fiber.
   */
  void
  check_apart(const std::vector<Fiber> &fibers);
} // namespace fiberloom

#endif
