// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_fabric_curve_h
#define fiberloom_fabric_curve_h

#include <fiberloom/base/vector_types.h>

#include <functional>
#include <string>
#include <vector>

namespace fiberloom
{
  using Polyline = std::vector<Vector3>; // [mm]

  /** A curve over the parameter s in [0, 1]. */
  struct Curve
  {
    std::function<Vector3(double)> point;      // [mm]
    std::function<Vector3(double)> derivative; // by s
    unsigned int n_pieces; // intervals of s needed to tell its speed
  };

  /** Nodes at equal distances along a curve, and the unit tangents there. */
  struct CenterLine
  {
    std::vector<Vector3> nodes; // [mm]
    std::vector<Vector3> tangents;
  };

  /**
   * The curve of three functions of s and i with semicolons between, for the
   * value @p i . The derivative is that of the quartic through five points 1e-4
   * apart, all of them in [0, 1]. Throws InputError for what cannot be parsed.
   */
  Curve
  parsed_curve(const std::string &functions, const unsigned int i);

  /**
   * The cubic spline through @p points , three or more, with continuous
   * curvature over the length of the chords. Its slopes at the ends are those
   * of the polynomials through the five points there, or through all.
   */
  Curve
  smooth_curve(const Polyline &points);

  /**
   * Divides @p curve by @p n_nodes nodes at equal distances. Throws InputError
   * where it is not finite, stands still, has no length or turns by a right
   * angle or more from one node to the next.
   */
  CenterLine
  divide(const Curve &curve, const unsigned int n_nodes);

  /**
   * The same for straight lines between @p points ; tangents are those of the
   * quadratic curves through the nodes.
   */
  CenterLine
  divide(const Polyline &points, const unsigned int n_nodes);
} // namespace fiberloom

#endif
