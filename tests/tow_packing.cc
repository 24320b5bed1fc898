// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// Layers by default; in every packing, the least distance between two axes is
// the spacing and the tow is centred, also where layers of equal parity would
// lie fiber on fiber.

#include <fiberloom/base/exceptions.h>

#include <fiberloom/fabric/tow_packing.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>

using namespace fiberloom;

using Layers = std::vector<unsigned int>;

std::ostream &
operator<<(std::ostream &out, const Layers &layers)
{
  for (const unsigned int n : layers)
    out << n << ' ';
  return out;
}

double
least_distance(const std::vector<SectionPoint> &points)
{
  double least = 1e9;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      least = std::min(least,
                       std::hypot(points[i][0] - points[j][0],
                                  points[i][1] - points[j][1]));
  return least;
}

/** Greatest and least coordinate in direction @p d . */
SectionPoint
extent(const std::vector<SectionPoint> &points, const unsigned int d)
{
  SectionPoint extent = {{-1e9, 1e9}};
  for (const SectionPoint &point : points)
    {
      extent[0] = std::max(extent[0], point[d]);
      extent[1] = std::min(extent[1], point[d]);
    }
  return extent;
}

void
check_all_numbers(std::ostream &output)
{
  unsigned int n_wrong_sums = 0, n_close = 0, n_uneven = 0;
  for (unsigned int n = 1; n <= 200; ++n)
    {
      const Layers layers = default_layers(n);
      n_wrong_sums += std::accumulate(layers.begin(), layers.end(), 0u) != n;
      const auto [least, most] =
        std::minmax_element(layers.begin(), layers.end());
      n_uneven += *most > *least + 1;
      n_close += least_distance(tow_packing(layers, 2.06)) < 2.06 - 1e-9;
    }
  output << "1 to 200 fibers: wrong sums " << n_wrong_sums << ", uneven "
         << n_uneven << ", too close " << n_close << std::endl;
}

int
main()
{
  std::ofstream output("output");

  for (const unsigned int n : {1, 2, 3, 7, 19, 22, 24, 30, 31, 37, 44})
    output << n << " fibers: " << default_layers(n) << std::endl;
  check_all_numbers(output);

  for (const Layers &layers : {Layers{2, 3, 2},
                               Layers{7, 6, 6},
                               Layers{8, 8, 8},
                               Layers{11, 11, 11, 11},
                               Layers{1, 4, 2, 2}})
    {
      const std::vector<SectionPoint> points = tow_packing(layers, 2.06);
      const SectionPoint x = extent(points, 0), z = extent(points, 1);
      output << layers << ": least distance " << least_distance(points)
             << ", half width " << x[0] << ", half height " << z[0]
             << ", centred "
             << (std::abs(x[0] + x[1]) + std::abs(z[0] + z[1]) < 1e-12)
             << std::endl;
    }

  for (const double spacing : {1.99, 2.})
    try
      {
        output << "spacing " << spacing << ": "
               << tow_packing({2, 3, 2}, spacing).size() << " fibers"
               << std::endl;
      }
    catch (const InputError &)
      {
        output << "rejected" << std::endl;
      }
}
