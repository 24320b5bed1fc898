// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_beams_shape_functions_h
#define fiberloom_beams_shape_functions_h

#include <array>

namespace fiberloom
{
  /** The quadratic Lagrange functions of nodes -1, 0, 1 at @p xi . */
  inline std::array<double, 3>
  shape_values(const double xi)
  {
    return {{.5 * xi * (xi - 1), 1 - xi * xi, .5 * xi * (xi + 1)}};
  }

  /** Derivatives of shape_values() by @p xi . */
  inline std::array<double, 3>
  shape_derivatives(const double xi)
  {
    return {{xi - .5, -2 * xi, xi + .5}};
  }
} // namespace fiberloom

#endif
