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

    struct CurvePlot
    {
      std::string              abscissa_name = "load";
      Values                   abscissa;
      std::string              quantity; // "force [N]"
      std::vector<std::string> names;
      std::vector<Values>      ordinates;
    };

    bool
    ends_with(const std::string &text, const std::string &end)
    {
      return text.size() >= end.size() &&
             text.compare(text.size() - end.size(), end.size(), end) == 0;
    }

    bool
    is_deformation(const std::string &name)
    {
      for (const char *start :
           {"strain", "shear_angle", "bending_angle", "fiber_volume_fraction"})
        if (name.rfind(start, 0) == 0)
          return true;
      return false;
    }

    bool
    has_values(const Values &values)
    {
      return std::count_if(values.begin(), values.end(), [](const double v) {
               return std::isfinite(v);
             }) >= 2;
    }

    double
    largest_value(const Values &values)
    {
      CurveRange range;
      range.include(values);
      return range.high - range.low;
    }

    void
    choose_abscissa(const LoadingCurve &curve,
                    const unsigned int  stage,
                    CurvePlot          &plot)
    {
      double largest = 0;
      plot.abscissa  = curve.loads(stage);
      for (unsigned int c = 0; c < curve.columns().size(); ++c)
        {
          const auto values = curve.values(stage, c);
          // equal strains differ by rounding: the first one is to be taken
          if (is_deformation(curve.columns()[c]) && has_values(values) &&
              largest_value(values) > largest * (1 + 1e-6))
            {
              largest            = largest_value(values);
              plot.abscissa_name = curve.columns()[c];
              plot.abscissa      = values;
            }
        }
    }

    void
    choose_ordinates(const LoadingCurve &curve,
                     const unsigned int  stage,
                     CurvePlot          &plot)
    {
      struct Quantity
      {
        const char *name, *part, *end;
      };
      for (const Quantity &quantity :
           {Quantity{"moment [N.mm]", "bending_moment", "[N.mm]"},
            Quantity{"force [N]", "", "[N]"},
            Quantity{"moment [N.mm]", "moment", "[N.mm]"},
            Quantity{"pressure [MPa]", "pressure", "[MPa]"}})
        {
          for (unsigned int c = 0; c < curve.columns().size(); ++c)
            if (const std::string &column = curve.columns()[c];
                ends_with(column, quantity.end) &&
                column.find(quantity.part) != std::string::npos &&
                column.find("contact_force") == std::string::npos &&
                has_values(curve.values(stage, c)))
              {
                plot.names.push_back(column);
                plot.ordinates.push_back(curve.values(stage, c));
              }
          plot.quantity = quantity.name;
          if (!plot.names.empty())
            return;
        }
    }

    Color
    curve_color(const std::string &name, const unsigned int i)
    {
      if (name.find("warp") != std::string::npos)
        return palette_color(0);
      if (name.find("fill") != std::string::npos)
        return palette_color(1);
      return palette_color(i + 2);
    }

    class CurveSheet
    {
    public:
      CurveSheet(const CurvePlot &plot, const double error)
        : plot(plot)
        , picture(width, height)
      {
        x_range.include(plot.abscissa);
        for (const auto &values : plot.ordinates)
          y_range.include(values);
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
          for (unsigned int i = 0; i < plot.names.size(); ++i)
            error_band(i);
        for (unsigned int i = 0; i < plot.names.size(); ++i)
          curve(i);
        for (unsigned int i = 0; i < plot.names.size(); ++i)
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
                     readable(plot.abscissa_name),
                     16,
                     SvgPicture::Anchor::middle);
        picture.text({{26, .5 * (top + bottom)}},
                     plot.quantity,
                     16,
                     SvgPicture::Anchor::middle,
                     true);
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
              std::isfinite(plot.ordinates[i][k]))
            border.push_back(
              {{x(plot.abscissa[k]),
                y(std::max(plot.ordinates[i][k] + side * band, y_range.low))}});
        };
        for (std::size_t k = first; k <= last; ++k)
          append(k, 1);
        for (std::size_t k = last + 1; k-- > first;)
          append(k, -1);
        const Color light = curve_color(plot.names[i], i).lighter(.7);
        picture.polygon(border, light, light, 0);
      }

      void
      curve(const unsigned int i)
      {
        std::vector<SvgPicture::Point> points;
        for (std::size_t k = 0; k < plot.abscissa.size(); ++k)
          if (std::isfinite(plot.abscissa[k]) &&
              std::isfinite(plot.ordinates[i][k]))
            points.push_back({{x(plot.abscissa[k]), y(plot.ordinates[i][k])}});

        // curves that coincide must both be seen: later ones thinner
        const double thickness = std::max(1.6, 5. - 2.6 * i);
        const Color  color     = curve_color(plot.names[i], i);
        picture.polyline(points, color, thickness);
        for (const auto &point : points)
          picture.disc(point, thickness + 1.6, color);
      }

      void
      legend(const unsigned int i)
      {
        const double row   = top + 24 + 24 * i;
        const Color  color = curve_color(plot.names[i], i);
        picture.line({{left + 20, row - 5}}, {{left + 56, row - 5}}, color, 4);
        picture.text({{left + 66, row}}, readable(plot.names[i]), 15);
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
  readable(std::string column)
  {
    std::replace(column.begin(), column.end(), '_', ' ');
    const auto unit = column.find('[');
    if (unit != std::string::npos)
      column.insert(unit, " ");
    return column;
  }



  std::string
  curve_picture(const LoadingCurve &curve,
                const unsigned int  stage_index,
                const double        error)
  {
    CurvePlot plot;
    choose_abscissa(curve, stage_index, plot);
    choose_ordinates(curve, stage_index, plot);
    if (plot.names.empty())
      return "";

    std::string stage;
    for (const auto &row : curve.rows())
      if (row.stage_index == stage_index)
        stage = row.stage;
    return CurveSheet(plot, error).draw("loading curve, stage " + stage);
  }
} // namespace fiberloom
