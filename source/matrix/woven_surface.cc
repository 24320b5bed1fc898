// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>

#include <fiberloom/matrix/woven_surface.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace fiberloom
{
  namespace
  {
    constexpr double       nothing = -std::numeric_limits<double>::infinity();
    constexpr unsigned int samples_per_cell = 8; // along a fiber

    /** Vertices of evenly spaced @p lines within half a cell of @p position :
     * one, or two on a border between. */
    std::array<int, 2>
    near_lines(const std::vector<double> &lines, const double position)
    {
      const double cell = lines[1] - lines[0];
      const double t    = (position - lines[0]) / cell;
      return {{static_cast<int>(std::ceil(t - .5 - 1e-9)),
               static_cast<int>(std::floor(t + .5 + 1e-9))}};
    }

    /** Takes heights into the gaps from around them, ring by ring, and from
     * beyond periodic borders as well. */
    void
    fill_gaps(std::vector<double> &heights,
              const int            n_x,
              const int            n_y,
              const Borders        borders)
    {
      // Opposite borders of a cell are the same line.
      const auto neighbor = [&](const int i, const int n) {
        return borders == Borders::periodic ? (i + n - 1) % (n - 1) : i;
      };
      for (bool gaps = true; gaps;)
        {
          gaps              = false;
          const auto before = heights;
          for (int j = 0; j < n_y; ++j)
            for (int i = 0; i < n_x; ++i)
              {
                if (before[i + n_x * j] != nothing)
                  continue;
                gaps       = true;
                double sum = 0;
                int    n   = 0;
                for (int db = -1; db <= 1; ++db)
                  for (int da = -1; da <= 1; ++da)
                    {
                      const int a = neighbor(i + da, n_x),
                                b = neighbor(j + db, n_y);
                      if (a < 0 || a >= n_x || b < 0 || b >= n_y ||
                          before[a + n_x * b] == nothing)
                        continue;
                      sum += before[a + n_x * b];
                      ++n;
                    }
                if (n > 0)
                  heights[i + n_x * j] = sum / n;
              }
        }
    }
  } // namespace



  namespace
  {
    double
    move_between(const std::vector<double> &lines, const double position)
    {
      const double size = lines.back() - lines.front();
      return position - size * std::floor((position - lines.front()) / size);
    }

    /** Gives vertices on opposite borders the larger of their heights. */
    void
    join_borders(std::vector<double> &heights,
                 const unsigned int   n_x,
                 const unsigned int   n_y)
    {
      const auto join = [&](const unsigned int a, const unsigned int b) {
        heights[a] = heights[b] = std::max(heights[a], heights[b]);
      };
      for (unsigned int j = 0; j < n_y; ++j)
        join(n_x * j, n_x * j + n_x - 1);
      for (unsigned int i = 0; i < n_x; ++i)
        join(i, i + n_x * (n_y - 1));
    }
  } // namespace



  std::array<double, 2>
  outermost_particle(const Section &section, const Side side)
  {
    const double z1 = section.vector_1.z(), z2 = section.vector_2.z();
    const double length =
      (side == Side::upper ? 1 : -1) * std::sqrt(z1 * z1 + z2 * z2);
    if (length == 0)
      return {{0., 0.}};
    return {{z1 / length, z2 / length}};
  }



  std::vector<double>
  surface_heights(const FiberMesh           &mesh,
                  const DofVector           &q,
                  const Side                 side,
                  const std::vector<double> &x,
                  const std::vector<double> &y)
  {
    const double  sign = side == Side::upper ? 1 : -1;
    const double  step = std::min(x[1] - x[0], y[1] - y[0]) / samples_per_cell;
    const int     n_x = x.size(), n_y = y.size();
    const Borders borders = borders_of(mesh);
    std::vector<double> heights(n_x * n_y, nothing); // times the sign
    for (unsigned int f = 0; f < mesh.lines().size(); ++f)
      {
        const auto  &line      = mesh.lines()[f];
        const double length    = line.length / line.n_elements;
        const int    n_samples = std::max(2., std::ceil(length / step));
        for (unsigned int s = 0; s <= n_samples * line.n_elements; ++s)
          {
            const Section section =
              mesh.section(q, mesh.locate(f, double(s) / n_samples));
            const auto   particle = outermost_particle(section, side);
            const double height =
              sign * (section.center + particle[0] * section.vector_1 +
                      particle[1] * section.vector_2)
                       .z();
            Vector3 center = section.center;
            if (borders == Borders::periodic)
              center << move_between(x, center.x()),
                move_between(y, center.y()), center.z();
            const auto i = near_lines(x, center.x());
            const auto j = near_lines(y, center.y());
            for (int b = std::max(0, j[0]); b <= std::min(n_y - 1, j[1]); ++b)
              for (int a = std::max(0, i[0]); a <= std::min(n_x - 1, i[1]); ++a)
                heights[a + n_x * b] = std::max(heights[a + n_x * b], height);
          }
      }
    if (*std::max_element(heights.begin(), heights.end()) == nothing)
      throw InputError("Matrix: no fiber is in reach of the layers; allowed: "
                       "a Size that holds some");
    if (borders == Borders::periodic)
      join_borders(heights, n_x, n_y);
    fill_gaps(heights, n_x, n_y, borders);
    for (double &height : heights)
      height *= sign;
    return heights;
  }
} // namespace fiberloom
