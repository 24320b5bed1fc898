// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/contact/line_weights.h>

#include <algorithm>
#include <cmath>

namespace fiberloom
{
  namespace
  {
    // Half of the length on which polynomials are blended, over that of an
    // element: short, as a contact there couples the nodes of both.
    constexpr double blended = .05;

    /** Those of element @p e at @p u , from where the pointers lead. */
    void
    set_polynomials(const double e,
                    const double u,
                    double      *value,
                    double      *first,
                    double      *second)
    {
      const double xi     = 2 * (u - e) - 1;
      const auto   values = shape_values(xi), slopes = shape_derivatives(xi);
      for (unsigned int a = 0; a < 3; ++a)
        {
          value[a] = values[a];
          first[a] = 2 * slopes[a];
        }
      second[0] = second[2] = 4;
      second[1]             = -8;
    }
  } // namespace



  LineWeights::LineWeights(const FiberMesh::Line &line, const double u)
  {
    const double border = std::round(u), x = u - border;
    if (std::abs(x) >= blended || border <= 0 || border >= line.n_elements)
      {
        const double e = std::clamp(std::floor(u), 0., line.n_elements - 1.);
        n              = 3;
        first_node     = line.first_node + 2 * static_cast<unsigned int>(e);
        set_polynomials(e, u, value.data(), first.data(), second.data());
        return;
      }

    n          = 5;
    first_node = line.first_node + 2 * static_cast<unsigned int>(border - 1);
    double before[3][5] = {}, after[3][5] = {};
    set_polynomials(border - 1, u, before[0], before[1], before[2]);
    set_polynomials(border, u, after[0] + 2, after[1] + 2, after[2] + 2);
    // The polynomial of degree five that goes from 0 to 1 with two derivatives
    // of zero at both ends.
    const double t = (x + blended) / (2 * blended), slope = 1 / (2 * blended);
    const double part = t * t * t * (10 - 15 * t + 6 * t * t),
                 d    = 30 * t * t * (1 - t) * (1 - t) * slope,
                 dd   = 60 * t * (1 - t) * (1 - 2 * t) * slope * slope;
    for (unsigned int a = 0; a < 5; ++a)
      {
        const double v = after[0][a] - before[0][a],
                     f = after[1][a] - before[1][a],
                     s = after[2][a] - before[2][a];
        value[a]       = before[0][a] + part * v;
        first[a]       = before[1][a] + part * f + d * v;
        second[a]      = before[2][a] + part * s + 2 * d * f + dd * v;
      }
  }
} // namespace fiberloom
