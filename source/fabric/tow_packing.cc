// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/parameter_catalogue.h>

#include <fiberloom/fabric/tow_packing.h>

#include <algorithm>
#include <cmath>

namespace fiberloom
{
  namespace
  {
    unsigned int
    default_number_of_layers(const unsigned int n_fibers)
    {
      if (n_fibers <= 2)
        return 1;
      if (n_fibers <= 6)
        return 2;
      // 44 fibers in 4 layers, 24 in 3
      return std::max(3l, std::lround(std::sqrt(n_fibers / 2.5)));
    }

    void
    center(std::vector<SectionPoint> &points)
    {
      for (unsigned int d = 0; d < 2; ++d)
        {
          const auto by_coordinate = [d](const SectionPoint &a,
                                         const SectionPoint &b) {
            return a[d] < b[d];
          };
          const auto [least, greatest] =
            std::minmax_element(points.begin(), points.end(), by_coordinate);
          const double middle = .5 * ((*least)[d] + (*greatest)[d]);
          for (SectionPoint &point : points)
            point[d] -= middle;
        }
    }

    void
    check_distances(const std::vector<SectionPoint> &points)
    {
      for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          {
            const double distance = std::hypot(points[i][0] - points[j][0],
                                               points[i][1] - points[j][1]);
            if (distance < 2 * (1 - 1e-12))
              throw InputError("the axes of fibers " + std::to_string(j) +
                               " and " + std::to_string(i) + " of a tow are " +
                               exact_text(distance) +
                               " radii apart; allowed: at least 2");
          }
    }
  } // namespace

  std::vector<unsigned int>
  default_layers(const unsigned int n_fibers)
  {
    const unsigned int        n_layers = default_number_of_layers(n_fibers);
    std::vector<unsigned int> layers(n_layers, n_fibers / n_layers);

    // those left over go to the middle, then to both sides of it
    unsigned int rest = n_fibers % n_layers;
    if (n_layers % 2 == 1 && rest % 2 == 1)
      {
        ++layers[n_layers / 2];
        --rest;
      }
    for (unsigned int k = 0; rest > 0; ++k)
      {
        ++layers[n_layers / 2 - 1 - k];
        if (--rest > 0)
          {
            ++layers[(n_layers + 1) / 2 + k];
            --rest;
          }
      }
    return layers;
  }

  std::vector<SectionPoint>
  tow_packing(const std::vector<unsigned int> &layers, const double spacing)
  {
    std::vector<SectionPoint> points;
    double                    shift = 0, side = .5;
    for (std::size_t k = 0; k < layers.size(); ++k)
      {
        // layers of equal parity would lie fiber on fiber if both were centred
        if (k > 0 && (layers[k] + layers[k - 1]) % 2 == 0)
          {
            shift += side;
            side = -side;
          }
        for (unsigned int i = 0; i < layers[k]; ++i)
          points.push_back({{spacing * (i - .5 * (layers[k] - 1.) + shift),
                             spacing * std::sqrt(.75) * k}});
      }
    center(points);
    check_distances(points);
    return points;
  }
} // namespace fiberloom
