// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>

#include <fiberloom/output/canvas.h>

#include <deal.II/base/utilities.h>

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>

namespace fiberloom
{
  namespace
  {
    /** Mean over 2 @p n + 1 neighbours of @p count values, @p stride apart. */
    void
    box_blur(const float *input,
             float       *output,
             const int    count,
             const int    stride,
             const int    n)
    {
      double     sum   = 0;
      const auto value = [&](const int i) {
        return input[std::clamp(i, 0, count - 1) * stride];
      };
      for (int i = -n; i <= n; ++i)
        sum += value(i);
      for (int i = 0; i < count; ++i)
        {
          output[i * stride] = sum / (2 * n + 1);
          sum += value(i + n + 1) - value(i - n);
        }
    }

    std::string
    encode_png(const std::vector<unsigned char> &bytes,
               const unsigned int                width,
               const unsigned int                height)
    {
      vtkNew<vtkImageData> image;
      image->SetDimensions(width, height, 1);
      image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
      auto *target = static_cast<unsigned char *>(image->GetScalarPointer());
      for (unsigned int y = 0; y < height; ++y) // VTK counts from below
        std::copy_n(&bytes[3 * y * width],
                    3 * width,
                    target + 3 * (height - 1 - y) * width);

      vtkNew<vtkPNGWriter> writer;
      writer->SetInputData(image);
      writer->WriteToMemoryOn();
      writer->Write();
      vtkUnsignedCharArray *content = writer->GetResult();
      if (content == nullptr)
        throw StageFailure("a picture could not be encoded");
      return std::string(reinterpret_cast<const char *>(content->GetPointer(0)),
                         content->GetNumberOfValues());
    }
  } // namespace



  Canvas::Canvas(const unsigned int width, const unsigned int height)
    : width(2 * width)
    , height(2 * height)
    , pixels(4 * std::size_t(width) * height)
  {}



  void
  Canvas::draw(const std::array<Corner, 3> &corners,
               const Color                 &color,
               const int                    object)
  {
    std::array<Vector3, 3> p;
    for (unsigned int c = 0; c < 3; ++c)
      p[c] = Vector3(2 * corners[c].position[0],
                     2 * corners[c].position[1],
                     2 * corners[c].position[2]);

    const auto edge =
      [](const Vector3 &a, const Vector3 &b, const double x, const double y) {
        return (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
      };
    const double area = edge(p[0], p[1], p[2][0], p[2][1]);
    const bool   turned_away =
      std::all_of(corners.begin(), corners.end(), [](const Corner &corner) {
        return corner.normal[2] < 0;
      });
    if (area == 0 || turned_away)
      return;

    if (unsigned(object) >= colors.size())
      colors.resize(object + 1);
    colors[object] = color;

    const auto range = [&](const unsigned int d, const unsigned int size) {
      const auto [low, high] = std::minmax({p[0][d], p[1][d], p[2][d]});
      return std::array<int, 2>{
        {std::max(0, int(std::floor(low))),
         std::min(int(size) - 1, int(std::ceil(high)))}};
    };
    const auto columns = range(0, width), rows = range(1, height);

    // Barycentric coordinates of pixels, linear in a row.
    const auto weights = [&](const double x, const double y) {
      Vector3 weight;
      for (unsigned int c = 0; c < 3; ++c)
        weight[c] = edge(p[(c + 1) % 3], p[(c + 2) % 3], x, y) / area;
      return weight;
    };
    const Vector3 step = weights(1, 0) - weights(0, 0);

    for (int y = rows[0]; y <= rows[1]; ++y)
      {
        const Vector3 first = weights(columns[0] + .5, y + .5);
        for (int x = columns[0]; x <= columns[1]; ++x)
          {
            const Vector3 weight = first + (x - columns[0]) * step;
            if (weight.minCoeff() < -1e-9) // no gap between neighbours
              continue;

            double  depth  = 0;
            Vector3 normal = Vector3::Zero();
            for (unsigned int c = 0; c < 3; ++c)
              {
                depth += weight[c] * p[c][2];
                normal += weight[c] * corners[c].normal;
              }
            Pixel &pixel = pixels[std::size_t(y) * width + x];
            if (depth >= pixel.depth)
              continue;
            normal.normalize();
            pixel.depth  = depth;
            pixel.object = object;
            for (unsigned int c = 0; c < 3; ++c)
              pixel.normal[c] = normal[c];
          }
      }
  }



  std::vector<float>
  Canvas::blurred_depth(const double reach) const
  {
    float furthest = -std::numeric_limits<float>::max();
    for (const Pixel &pixel : pixels)
      if (pixel.object >= 0)
        furthest = std::max(furthest, pixel.depth);

    const unsigned int w = width / 2, h = height / 2;
    std::vector<float> depth(std::size_t(w) * h), other(depth.size());
    for (unsigned int y = 0; y < h; ++y)
      for (unsigned int x = 0; x < w; ++x)
        for (unsigned int s = 0; s < 4; ++s)
          depth[std::size_t(y) * w + x] +=
            .25f * std::min(furthest, at(2 * x + s % 2, 2 * y + s / 2).depth);

    const int n = std::max(1, int(reach));
    for (unsigned int pass = 0; pass < 2; ++pass)
      {
        for (unsigned int y = 0; y < h; ++y)
          box_blur(
            &depth[std::size_t(y) * w], &other[std::size_t(y) * w], w, 1, n);
        for (unsigned int x = 0; x < w; ++x)
          box_blur(&other[x], &depth[x], h, w, n);
      }
    return depth;
  }



  bool
  Canvas::is_border(const unsigned int x, const unsigned int y) const
  {
    const Pixel &here = at(x, y);
    for (const auto &[dx, dy] : {std::array<int, 2>{{1, 0}},
                                 std::array<int, 2>{{-1, 0}},
                                 std::array<int, 2>{{0, 1}},
                                 std::array<int, 2>{{0, -1}}})
      {
        const int nx = int(x) + dx, ny = int(y) + dy;
        if (nx < 0 || ny < 0 || nx >= int(width) || ny >= int(height))
          continue;
        const Pixel &there = at(nx, ny);
        if (there.object != here.object && there.depth < here.depth)
          return true;
      }
    return false;
  }



  std::array<float, 3>
  Canvas::shade(const unsigned int x,
                const unsigned int y,
                const float        shadow) const
  {
    static const Vector3 light   = Vector3(-.45, -.65, .62).normalized();
    static const Vector3 halfway = (light + Vector3::UnitZ()).normalized();

    const Pixel &pixel = at(x, y);
    if (is_border(x, y))
      return {{.12f, .12f, .12f}};
    if (pixel.object < 0)
      return {{1, 1, 1}};

    const Vector3 normal(pixel.normal[0], pixel.normal[1], pixel.normal[2]);
    const double  diffuse = .42 + .66 * std::max(0., normal.dot(light));
    const double  gloss   = .30 * dealii::Utilities::fixed_power<30>(
                                 std::max(0., normal.dot(halfway)));
    const Color         &color = colors[pixel.object];
    std::array<float, 3> result;
    for (unsigned int c = 0; c < 3; ++c)
      result[c] =
        std::clamp<float>((color.rgb[c] * diffuse + gloss) * shadow, 0.f, 1.f);
    return result;
  }



  std::string
  Canvas::png(const double reach) const
  {
    const std::vector<float> around = blurred_depth(reach);

    const unsigned int         w = width / 2, h = height / 2;
    std::vector<unsigned char> bytes(3 * std::size_t(w) * h);
    for (unsigned int y = 0; y < h; ++y)
      for (unsigned int x = 0; x < w; ++x)
        {
          std::array<float, 3> mean{{0, 0, 0}};
          for (unsigned int s = 0; s < 4; ++s)
            {
              const unsigned int px = 2 * x + s % 2, py = 2 * y + s / 2;
              const float        below =
                at(px, py).depth - around[std::size_t(y) * w + x];
              const float shadow =
                1 - std::clamp<float>(.45 * below / (2 * reach), 0.f, .62f);
              const auto color = shade(px, py, shadow);
              for (unsigned int c = 0; c < 3; ++c)
                mean[c] += .25f * color[c];
            }
          for (unsigned int c = 0; c < 3; ++c)
            bytes[3 * (std::size_t(y) * w + x) + c] =
              std::lround(255 * mean[c]);
        }
    return encode_png(bytes, w, h);
  }
} // namespace fiberloom
