// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_colors_h
#define fiberloom_output_colors_h

#include <fiberloom/fabric/fiber_set.h>

#include <array>
#include <string>

namespace fiberloom
{
  /** Red, green and blue in [0, 1]. */
  struct Color
  {
    std::array<double, 3> rgb;

    /** Towards white for a positive @p amount in [-1, 1], else to black. */
    Color
    lighter(const double amount) const;

    /** The color as text, such as "#1f77b4". */
    std::string
    hexadecimal() const;
  };

  /** Warp tows in shades of blue, fill tows of orange, others by number. */
  Color
  tow_color(const Tow &tow);

  /** The @p i th of some colours that are told apart with ease. */
  Color
  palette_color(const unsigned int i);
} // namespace fiberloom

#endif
