// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/output/colors.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace fiberloom
{
  Color
  Color::lighter(const double amount) const
  {
    Color result;
    for (unsigned int c = 0; c < 3; ++c)
      result.rgb[c] =
        amount > 0 ? rgb[c] + amount * (1 - rgb[c]) : rgb[c] * (1 + amount);
    return result;
  }



  std::string
  Color::hexadecimal() const
  {
    std::array<char, 8>         text;
    std::array<unsigned int, 3> bytes;
    for (unsigned int c = 0; c < 3; ++c)
      bytes[c] = std::lround(255 * std::clamp(rgb[c], 0., 1.));
    std::snprintf(text.data(),
                  text.size(),
                  "#%02x%02x%02x",
                  bytes[0] & 255,
                  bytes[1] & 255,
                  bytes[2] & 255);
    return text.data();
  }



  Color
  tow_color(const Tow &tow)
  {
    // neighbours differ, so that a tow can be followed by eye
    const std::array<double, 3> shades{{0, .22, -.16}};
    const double                shade = shades[tow.number % shades.size()];
    switch (tow.family)
      {
        case Tow::Family::warp:
          return Color{{{.22, .47, .69}}}.lighter(shade);
        case Tow::Family::fill:
          return Color{{{.90, .55, .22}}}.lighter(shade);
        default:
          return palette_color(tow.number);
      }
  }



  Color
  palette_color(const unsigned int i)
  {
    const std::array<Color, 7> palette{{{{{.22, .47, .69}}},
                                        {{{.90, .55, .22}}},
                                        {{{.27, .60, .36}}},
                                        {{{.74, .29, .29}}},
                                        {{{.53, .40, .66}}},
                                        {{{.50, .42, .37}}},
                                        {{{.25, .62, .66}}}}};
    return palette[i % palette.size()];
  }
} // namespace fiberloom
