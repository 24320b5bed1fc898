// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/output/svg.h>

#include <cmath>

namespace fiberloom
{
  std::string
  escaped(const std::string &text)
  {
    std::string result;
    for (const char c : text)
      if (c == '&')
        result += "&amp;";
      else if (c == '<')
        result += "&lt;";
      else if (c == '>')
        result += "&gt;";
      else if (c == '"')
        result += "&quot;";
      else
        result += c;
    return result;
  }



  SvgPicture::SvgPicture(const double width, const double height)
    : width(width)
    , height(height)
  {
    body.setf(std::ios::fixed);
    body.precision(2);
  }



  void
  SvgPicture::line(const Point &from,
                   const Point &to,
                   const Color &color,
                   const double width)
  {
    polyline({from, to}, color, width);
  }



  void
  SvgPicture::polyline(const std::vector<Point> &points,
                       const Color              &color,
                       const double              width)
  {
    body << "<path fill=\"none\" stroke=\"" << color.hexadecimal()
         << "\" stroke-width=\"" << width
         << "\" stroke-linejoin=\"round\" d=\"";
    path(points);
    body << "\"/>\n";
  }



  void
  SvgPicture::polygon(const std::vector<Point> &points,
                      const Color              &fill,
                      const Color              &border,
                      const double              border_width)
  {
    body << "<path fill=\"" << fill.hexadecimal() << "\" stroke=\""
         << border.hexadecimal() << "\" stroke-width=\"" << border_width
         << "\" d=\"";
    path(points);
    body << "Z\"/>\n";
  }



  void
  SvgPicture::disc(const Point &center, const double radius, const Color &fill)
  {
    body << "<circle cx=\"" << center[0] << "\" cy=\"" << center[1] << "\" r=\""
         << radius << "\" fill=\"" << fill.hexadecimal() << "\"/>\n";
  }



  void
  SvgPicture::begin_text(const Point &position,
                         const double size,
                         const Anchor anchor)
  {
    const char *const anchors[] = {"start", "middle", "end"};
    body << "<text x=\"" << position[0] << "\" y=\"" << position[1]
         << "\" font-size=\"" << size << "\" text-anchor=\""
         << anchors[static_cast<int>(anchor)] << "\"";
  }



  void
  SvgPicture::text(const Point       &position,
                   const std::string &content,
                   const double       size,
                   const Anchor       anchor)
  {
    begin_text(position, size, anchor);
    body << ">" << escaped(content) << "</text>\n";
  }



  void
  SvgPicture::upright_text(const Point       &position,
                           const std::string &content,
                           const double       size,
                           const Anchor       anchor)
  {
    begin_text(position, size, anchor);
    body << " transform=\"rotate(-90 " << position[0] << " " << position[1]
         << ")\">" << escaped(content) << "</text>\n";
  }



  std::string
  SvgPicture::str() const
  {
    std::ostringstream out;
    out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << width
        << "\" height=\"" << height << "\" viewBox=\"0 0 " << width << " "
        << height << "\" font-family=\"DejaVu Sans, Helvetica, sans-serif\" "
        << "fill=\"#222222\">\n"
        << "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n"
        << body.str() << "</svg>\n";
    return out.str();
  }



  void
  SvgPicture::path(const std::vector<Point> &points)
  {
    char command = 'M';
    for (const Point &point : points)
      {
        body << command << point[0] << " " << point[1];
        command = 'L';
      }
  }



  std::vector<double>
  axis_ticks(const double low, const double high, const unsigned int n)
  {
    if (!(high > low))
      return {low};
    const double raw   = (high - low) / n;
    const double power = std::pow(10., std::floor(std::log10(raw)));
    double       step  = 10 * power;
    for (const double factor : {5., 2., 1.})
      if (factor * power >= raw * .999)
        step = factor * power;

    std::vector<double> ticks;
    const double        first = std::ceil(low / step - 1e-9);
    for (double i = first; i * step <= high + 1e-9 * step; ++i)
      ticks.push_back(i * step);
    return ticks;
  }



  std::string
  short_number(const double value)
  {
    std::ostringstream out;
    out.precision(4);
    out << (std::abs(value) < 1e-300 ? 0. : value);
    return out.str();
  }
} // namespace fiberloom
