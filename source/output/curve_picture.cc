// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/output/curves.h>
#include <fiberloom/output/svg.h>

#include <algorithm>
#include <cmath>

namespace fiberloom
{
  namespace
  {
    using Values = std::vector<double>;

    struct CurveRange
    {
      double low  = 0;
      double high = 0;

      void
      include(const Values &values)
      {
        for (const double value : values)
          if (std::isfinite(value))
            {
              low  = std::min(low, value);
              high = std::max(high, value);
            }
      }
    };

    struct Line
    {
      Column column;
      Values values;
    };

    struct CurvePlot
    {
      std::string       abscissa_name = "load";
      Values            abscissa;
      std::string       quantity; // "force [N]"
      std::vector<Line> lines;
    };

    constexpr unsigned int most_lines = 6;

    // Parts of the largest value below which values only round.
    constexpr double rounding = 1e-6;

    double
    largest_value(const Values &values)
    {
      CurveRange range;
      range.include(values);
      return std::max(range.high, -range.low);
    }

    /** Of the values alone, without zero. */
    CurveRange
    tight_range(const Values &values)
    {
      CurveRange range{values.front(), values.front()};
      for (const double value : values)
        {
          range.low  = std::fmin(range.low, value);
          range.high = std::fmax(range.high, value);
        }
      return range;
    }

    /** Of a role, that have two values at least. */
    std::vector<Line>
    lines_of(const Role          role,
             const LoadingCurve &curve,
             const unsigned int  stage)
    {
      std::vector<Line> lines;
      for (const Column &column : curve.described_columns())
        if (column.role == role)
          {
            const Values values = curve.values(stage, column);
            if (std::count_if(values.begin(), values.end(), [](const double v) {
                  return std::isfinite(v);
                }) >= 2)
              lines.push_back({column, values});
          }
      return lines;
    }

    /** Returns what the abscissa is. */
    Quantity
    choose_abscissa(const LoadingCurve &curve,
                    const unsigned int  stage,
                    CurvePlot          &plot)
    {
      double   most     = 0;
      Quantity quantity = Quantity::number;
      plot.abscissa     = curve.loads(stage);
      for (const Line &line : lines_of(Role::deformation, curve, stage))
        // equal strains differ by rounding: the first one is to be taken
        if (const CurveRange range = tight_range(line.values);
            range.high - range.low > most * (1 + rounding))
          {
            most               = range.high - range.low;
            quantity           = line.column.quantity;
            plot.abscissa_name = readable(line.column.heading());
            plot.abscissa      = line.values;
          }
      return quantity;
    }

    void
    choose_lines(const LoadingCurve &curve,
                 const unsigned int  stage,
                 const Quantity      abscissa,
                 CurvePlot          &plot)
    {
      const std::vector<Line> responses =
        lines_of(Role::response, curve, stage);
      std::vector<Quantity> quantities = {Quantity::force, Quantity::moment};
      if (abscissa == Quantity::angle)
        std::reverse(quantities.begin(), quantities.end());
      quantities.push_back(Quantity::pressure);
      for (const Quantity quantity : quantities)
        {
          plot.lines.clear();
          for (const Line &line : responses)
            if (line.column.quantity == quantity)
              plot.lines.push_back(line);
          std::stable_sort(plot.lines.begin(),
                           plot.lines.end(),
                           [](const Line &a, const Line &b) {
                             return largest_value(a.values) >
                                    largest_value(b.values);
                           });
          if (plot.lines.size() > most_lines)
            plot.lines.resize(most_lines);
          while (!plot.lines.empty() &&
                 !(largest_value(plot.lines.back().values) >
                   rounding * largest_value(plot.lines.front().values)))
            plot.lines.pop_back();
          if (plot.lines.empty())
            continue;
          plot.quantity = name_of(quantity) + " [" + unit_of(quantity) + "]";
          return;
        }
    }

    Color
    line_color(const Tow::Family family, const unsigned int i)
    {
      switch (family)
        {
          case Tow::Family::warp:
            return palette_color(0);
          case Tow::Family::fill:
            return palette_color(1);
          default:
            return palette_color(i + 2);
        }
    }

    class CurveSheet
    {
    public:
      CurveSheet(const CurvePlot &plot, const double error)
        : plot(plot)
        , picture(width, height)
      {
        x_range = tight_range(plot.abscissa);
        for (const Line &line : plot.lines)
          y_range.include(line.values);
        if (std::isfinite(error))
          band = error * std::max(y_range.high, -y_range.low);
        y_range.high += band;
        y_range.low -= y_range.low < 0 ? band : 0;
        y_range.high += .06 * (y_range.high - y_range.low);
        if (!(y_range.high > y_range.low))
          y_range.high = y_range.low + 1;
        if (!(x_range.high > x_range.low))
          x_range.high = x_range.low + 1;
      }

      std::string
      draw(const std::string &title)
      {
        axes();
        if (band > 0)
          for (unsigned int i = 0; i < plot.lines.size(); ++i)
            error_band(i);
        for (unsigned int i = 0; i < plot.lines.size(); ++i)
          curve(i);
        for (unsigned int i = 0; i < plot.lines.size(); ++i)
          legend(i);
        picture.text({{left, top - 22}}, title, 19);
        return picture.str();
      }

    private:
      double
      x(const double value) const
      {
        return left + (right - left) * (value - x_range.low) /
                        (x_range.high - x_range.low);
      }

      double
      y(const double value) const
      {
        return bottom + (top - bottom) * (value - y_range.low) /
                          (y_range.high - y_range.low);
      }

      void
      axes()
      {
        const Color grid{{{.87, .87, .87}}}, ink{{{.25, .25, .25}}};
        for (const double tick : axis_ticks(x_range.low, x_range.high, 8))
          {
            picture.line({{x(tick), top}}, {{x(tick), bottom}}, grid);
            picture.text({{x(tick), bottom + 22}},
                         short_number(tick),
                         14,
                         SvgPicture::Anchor::middle);
          }
        for (const double tick : axis_ticks(y_range.low, y_range.high, 7))
          {
            picture.line({{left, y(tick)}}, {{right, y(tick)}}, grid);
            picture.text({{left - 10, y(tick) + 5}},
                         short_number(tick),
                         14,
                         SvgPicture::Anchor::end);
          }
        picture.line({{left, top}}, {{left, bottom}}, ink, 1.5);
        picture.line({{left, bottom}}, {{right, bottom}}, ink, 1.5);
        picture.text({{.5 * (left + right), height - 18}},
                     plot.abscissa_name,
                     16,
                     SvgPicture::Anchor::middle);
        picture.upright_text({{26, .5 * (top + bottom)}},
                             plot.quantity,
                             16,
                             SvgPicture::Anchor::middle);
      }

      void
      error_band(const unsigned int i)
      {
        // A polygon for each way in one direction: over a loop it would be
        // folded.
        const std::size_t n     = plot.abscissa.size();
        std::size_t       first = 0;
        const auto        turns = [&](const std::size_t k) {
          return (plot.abscissa[k] - plot.abscissa[k - 1]) *
                   (plot.abscissa[k + 1] - plot.abscissa[k]) <
                 0;
        };
        for (std::size_t k = 1; k < n; ++k)
          if (k + 1 == n || turns(k))
            {
              error_band(i, first, k);
              first = k;
            }
      }

      /** From row @p first to row @p last . */
      void
      error_band(const unsigned int i,
                 const std::size_t  first,
                 const std::size_t  last)
      {
        std::vector<SvgPicture::Point> border;
        const auto append = [&](const std::size_t k, const double side) {
          if (std::isfinite(plot.abscissa[k]) &&
              std::isfinite(plot.lines[i].values[k]))
            border.push_back({{x(plot.abscissa[k]),
                               y(std::max(plot.lines[i].values[k] + side * band,
                                          y_range.low))}});
        };
        for (std::size_t k = first; k <= last; ++k)
          append(k, 1);
        for (std::size_t k = last + 1; k-- > first;)
          append(k, -1);
        const Color light =
          line_color(plot.lines[i].column.family, i).lighter(.7);
        picture.polygon(border, light, light, 0);
      }

      void
      curve(const unsigned int i)
      {
        std::vector<SvgPicture::Point> points;
        for (std::size_t k = 0; k < plot.abscissa.size(); ++k)
          if (std::isfinite(plot.abscissa[k]) &&
              std::isfinite(plot.lines[i].values[k]))
            points.push_back(
              {{x(plot.abscissa[k]), y(plot.lines[i].values[k])}});

        // curves that coincide must both be seen: later ones thinner
        const double thickness = std::max(1.6, 5. - 2.6 * i);
        const Color  color     = line_color(plot.lines[i].column.family, i);
        picture.polyline(points, color, thickness);
        for (const auto &point : points)
          picture.disc(point, thickness + 1.6, color);
      }

      void
      legend(const unsigned int i)
      {
        const double row   = top + 24 + 24 * i;
        const Color  color = line_color(plot.lines[i].column.family, i);
        picture.line({{left + 20, row - 5}}, {{left + 56, row - 5}}, color, 4);
        picture.text({{left + 66, row}},
                     readable(plot.lines[i].column.heading()),
                     15);
      }

      static constexpr double width = 860, height = 600;
      static constexpr double left = 100, right = 830, top = 60, bottom = 520;

      const CurvePlot &plot;
      SvgPicture       picture;
      CurveRange       x_range, y_range;
      double           band = 0; // on each side
    };
  } // namespace



  std::string
  curve_picture(const LoadingCurve &curve,
                const unsigned int  stage_index,
                const double        error)
  {
    CurvePlot      plot;
    const Quantity abscissa = choose_abscissa(curve, stage_index, plot);
    choose_lines(curve, stage_index, abscissa, plot);
    if (plot.lines.empty())
      return "";

    std::string stage;
    for (const auto &row : curve.rows())
      if (row.stage_index == stage_index)
        stage = row.stage;
    return CurveSheet(plot, error).draw("loading curve, stage " + stage);
  }
} // namespace fiberloom
