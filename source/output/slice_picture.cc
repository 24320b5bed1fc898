// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/output/slices.h>
#include <fiberloom/output/svg.h>

#include <algorithm>

namespace fiberloom
{
  namespace
  {
    /** Maps the slice's plane to pixels, with the same scale on both axes. */
    class SliceFrame
    {
    public:
      explicit SliceFrame(const std::vector<SliceOutline> &outlines)
      {
        for (const auto &outline : outlines)
          for (const auto &point : outline.points)
            for (unsigned int d = 0; d < 2; ++d)
              {
                low[d]  = std::min(low[d], point[d]);
                high[d] = std::max(high[d], point[d]);
              }
        if (outlines.empty())
          low = high = {{0, 0}};
        const double room_across = width - 2 * margin, room_up = 700;
        scale  = std::min(room_across / std::max(high[0] - low[0], 1e-12),
                         room_up / std::max(high[1] - low[1], 1e-12));
        bottom = top + scale * (high[1] - low[1]);
      }

      SvgPicture::Point
      pixel(const std::array<double, 2> &point) const
      {
        const double left = .5 * (width - scale * (high[0] - low[0]));
        return {{left + scale * (point[0] - low[0]),
                 bottom - scale * (point[1] - low[1])}};
      }

      static constexpr double width = 1600, margin = 30, top = 70;

      std::array<double, 2> low{{1e300, 1e300}}, high{{-1e300, -1e300}};
      double                scale, bottom;
    };

    /** What is cut across must be seen where it overlaps what is cut along. */
    std::vector<SliceOutline>
    small_ones_last(std::vector<SliceOutline> outlines)
    {
      std::stable_sort(outlines.begin(),
                       outlines.end(),
                       [](const auto &a, const auto &b) {
                         return enclosed_area(a) > enclosed_area(b);
                       });
      return outlines;
    }

    void
    draw_length_bar(SvgPicture &picture, const SliceFrame &frame)
    {
      const double wanted = .15 * SliceFrame::width / frame.scale;
      const double length = axis_ticks(0, wanted, 2).back();

      const double left  = SliceFrame::margin;
      const double right = left + length * frame.scale;
      const double y     = frame.bottom + 34;
      const Color  ink{{{.2, .2, .2}}};
      picture.line({{left, y}}, {{right, y}}, ink, 3);
      for (const double x : {left, right})
        picture.line({{x, y - 6}}, {{x, y + 6}}, ink, 3);
      picture.text({{right + 14, y + 6}}, short_number(length) + " mm", 18);
    }

    void
    draw_families(SvgPicture &picture, const SliceFrame &frame)
    {
      double right = SliceFrame::width - SliceFrame::margin;
      for (const auto family : {Tow::Family::fill, Tow::Family::warp})
        {
          Tow tow;
          tow.family = family;
          tow.number = 0;
          picture.text({{right - 44, frame.bottom + 40}},
                       family == Tow::Family::warp ? "warp" : "fill",
                       18);
          picture.disc({{right - 60, frame.bottom + 34}}, 9, tow_color(tow));
          right -= 110;
        }
    }
  } // namespace



  std::string
  slice_picture(const FiberSet                  &fibers,
                const std::vector<SliceOutline> &outlines,
                const std::string               &title)
  {
    const SliceFrame frame(outlines);
    SvgPicture       picture(SliceFrame::width, frame.bottom + 70);
    picture.text({{SliceFrame::margin, 38}}, title, 24);

    bool is_fabric = false;
    for (const SliceOutline &outline : small_ones_last(outlines))
      {
        std::vector<SvgPicture::Point> points;
        for (const auto &point : outline.points)
          points.push_back(frame.pixel(point));
        const Tow  &tow   = fibers.tows[fibers.fibers[outline.fiber].tow];
        const Color color = tow_color(tow);
        picture.polygon(points, color, color.lighter(-.6), .8);
        is_fabric = is_fabric || tow.family != Tow::Family::none;
      }

    draw_length_bar(picture, frame);
    if (is_fabric)
      draw_families(picture, frame);
    return picture.str();
  }
} // namespace fiberloom
