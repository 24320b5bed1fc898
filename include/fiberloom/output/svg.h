// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_svg_h
#define fiberloom_output_svg_h

#include <fiberloom/output/colors.h>

#include <array>
#include <sstream>
#include <string>
#include <vector>

namespace fiberloom
{
  /** A picture under construction; positions in pixels, y downwards. */
  class SvgPicture
  {
  public:
    using Point = std::array<double, 2>;

    enum class Anchor
    {
      start,
      middle,
      end
    };

    SvgPicture(const double width, const double height);

    void
    line(const Point &from,
         const Point &to,
         const Color &color,
         const double width = 1);

    void
    polyline(const std::vector<Point> &points,
             const Color              &color,
             const double              width);

    void
    polygon(const std::vector<Point> &points,
            const Color              &fill,
            const Color              &border,
            const double              border_width);

    void
    disc(const Point &center, const double radius, const Color &fill);

    void
    text(const Point       &position,
         const std::string &content,
         const double       size,
         const Anchor       anchor = Anchor::start);

    /** Text that is read from below. */
    void
    upright_text(const Point       &position,
                 const std::string &content,
                 const double       size,
                 const Anchor       anchor = Anchor::start);

    /** The whole file. */
    std::string
    str() const;

  private:
    /** Writes the tag that begins a text, without its end. */
    void
    begin_text(const Point &position, const double size, const Anchor anchor);

    void
    path(const std::vector<Point> &points);

    double             width, height;
    std::ostringstream body;
  };

  /** @p text as XML and HTML want it. */
  std::string
  escaped(const std::string &text);

  /** Round values between @p low and @p high , some @p n of them. */
  std::vector<double>
  axis_ticks(const double low, const double high, const unsigned int n);

  /** Shortest decimal form, for labels. */
  std::string
  short_number(const double value);
} // namespace fiberloom

#endif
