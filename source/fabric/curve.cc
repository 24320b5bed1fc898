// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/parameter_catalogue.h>
#include <fiberloom/base/parsed_functions.h>

#include <fiberloom/fabric/curve.h>

#include <deal.II/base/point.h>

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace fiberloom
{
  namespace
  {
    Vector3
    difference_quotient(const std::function<Vector3(double)> &point,
                        const double                          s)
    {
      constexpr double h = 1e-4;
      using Weights      = std::array<double, 5>;
      constexpr Weights middle{{1, -8, 0, 8, -1}},
        start{{-25, 48, -36, 16, -3}}, end{{3, -16, 36, -48, 25}};
      const bool     at_start = s<2 * h, at_end = s> 1 - 2 * h;
      const Weights &weights  = at_start ? start : at_end ? end : middle;
      const double   first    = s - (at_start ? 0 : at_end ? 4 * h : 2 * h);
      Vector3        slope    = Vector3::Zero();
      for (unsigned int k = 0; k < 5; ++k)
        slope += weights[k] / (12 * h) * point(first + k * h);
      return slope;
    }

    /** Cubic pieces between points, from the slopes there. */
    struct Spline
    {
      std::vector<double>  knots; // from 0, at the lengths of the chords
      std::vector<Vector3> points, slopes;

      /** A piece at a place: p + x h (m + x (b + x c)). */
      struct Piece
      {
        double  h, x;
        Vector3 p, m, b, c;
      };

      Vector3
      point(const double s) const
      {
        const Piece at = piece(s);
        return at.p + at.x * at.h * (at.m + at.x * (at.b + at.x * at.c));
      }

      /** By s. */
      Vector3
      derivative(const double s) const
      {
        const Piece at = piece(s);
        return knots.back() * (at.m + at.x * (2 * at.b + 3 * at.x * at.c));
      }

      Piece
      piece(const double s) const
      {
        const double t = s * knots.back();
        const auto   next =
          std::upper_bound(knots.begin() + 1, knots.end() - 1, t);
        const std::size_t k = next - knots.begin() - 1;
        const double      h = knots[k + 1] - knots[k], x = (t - knots[k]) / h;
        const Vector3     d = (points[k + 1] - points[k]) / h;
        return {h,
                x,
                points[k],
                slopes[k],
                3 * d - 2 * slopes[k] - slopes[k + 1],
                slopes[k] + slopes[k + 1] - 2 * d};
      }
    };

    /** Slope at the first point of the quartic through the first five. */
    Vector3
    end_slope(const std::vector<double> &t, const Polyline &points)
    {
      const std::size_t n = std::min<std::size_t>(5, points.size());
      Polyline          divided(points.begin(), points.begin() + n);
      Vector3           slope  = Vector3::Zero();
      double            factor = 1;
      for (std::size_t order = 1; order < n; ++order)
        {
          for (std::size_t i = 0; i + order < n; ++i)
            divided[i] = (divided[i + 1] - divided[i]) / (t[i + order] - t[i]);
          slope += factor * divided[0];
          factor *= t[0] - t[order];
        }
      return slope;
    }

    /** Slopes of continuous curvature: elimination in a band of three. */
    void
    find_slopes(Spline &spline)
    {
      const std::vector<double> &t = spline.knots;
      const Polyline            &p = spline.points;
      const std::size_t          n = p.size();
      std::vector<Vector3>      &m = spline.slopes;

      m.resize(n);
      m.front() = end_slope(t, p);
      std::vector<double> back(t.rbegin(), t.rend());
      for (double &knot : back)
        knot = -knot;
      m.back() = -end_slope(back, Polyline(p.rbegin(), p.rend()));

      std::vector<double> upper(n, 0.);
      for (std::size_t i = 1; i + 1 < n; ++i)
        {
          const double before = t[i] - t[i - 1], after = t[i + 1] - t[i];
          Vector3      right = 3 * (after / before * (p[i] - p[i - 1]) +
                               before / after * (p[i + 1] - p[i]));
          if (i + 2 == n)
            right -= before * m[n - 1];
          const double pivot = 2 * (before + after) - after * upper[i - 1];
          upper[i]           = before / pivot;
          m[i]               = (right - after * m[i - 1]) / pivot;
        }
      for (std::size_t i = n - 2; i-- > 1;)
        m[i] -= upper[i] * m[i + 1];
    }

    /** Length from the start to the ends of equal intervals of s. */
    struct Lengths
    {
      std::vector<double> length, speed;

      explicit Lengths(const Curve &curve, const unsigned int n_pieces)
        : length(n_pieces + 1, 0.)
        , speed(n_pieces + 1)
      {
        const auto speed_at = [&curve](const double s) {
          const double speed = curve.derivative(s).norm();
          if (!std::isfinite(speed))
            throw InputError("it is not finite near s = " + exact_text(s) +
                             "; allowed: finite for s from 0 to 1");
          return speed;
        };
        const double h = 1. / n_pieces;
        speed[0]       = speed_at(0);
        for (unsigned int k = 0; k < n_pieces; ++k)
          {
            speed[k + 1] = speed_at((k + 1) * h);
            length[k + 1] =
              length[k] +
              h / 6 * (speed[k] + 4 * speed_at((k + .5) * h) + speed[k + 1]);
          }
      }

      /** The parameter where the length is @p part of all. */
      double
      parameter(const double part) const
      {
        const double      wanted = part * length.back();
        const std::size_t k =
          std::upper_bound(length.begin() + 1, length.end() - 1, wanted) -
          length.begin() - 1;
        const double h    = 1. / (length.size() - 1);
        const double rise = length[k + 1] - length[k];
        const double a = h * speed[k], b = h * speed[k + 1];
        const auto   missing = [&](const double x) {
          return length[k] - wanted +
                 x * (a + x * (3 * rise - 2 * a - b + x * (a + b - 2 * rise)));
        };
        if (missing(0) >= 0)
          return k * h;
        if (missing(1) <= 0)
          return (k + 1) * h;
        const auto [low, high] = boost::math::tools::bisect(
          missing, 0., 1., boost::math::tools::eps_tolerance<double>(50));
        return (k + .5 * (low + high)) * h;
      }
    };

    [[noreturn]] void
    fail_to_turn(const std::size_t node)
    {
      throw InputError("it turns by a right angle or more between nodes " +
                       std::to_string(node - 1) + " and " +
                       std::to_string(node) +
                       "; allowed: less, with more elements or a smoother "
                       "line");
    }

    void
    check_turns(const CenterLine &line)
    {
      for (std::size_t n = 1; n < line.nodes.size(); ++n)
        if (!(line.tangents[n].dot(line.tangents[n - 1]) > 0))
          fail_to_turn(n);
    }
  } // namespace



  Curve
  parsed_curve(const std::string &functions, const unsigned int i)
  {
    const auto parsed =
      std::make_shared<const ParsedFunctions<2>>(functions, 3, "s,i");
    const auto point = [parsed, i](const double s) {
      const dealii::Point<2> at(s, i);
      return Vector3(parsed->value(at, 0),
                     parsed->value(at, 1),
                     parsed->value(at, 2));
    };
    return {point,
            [point](const double s) { return difference_quotient(point, s); },
            256};
  }



  Curve
  smooth_curve(const Polyline &points)
  {
    const auto spline = std::make_shared<Spline>();
    spline->points    = points;
    spline->knots     = {0.};
    for (std::size_t i = 1; i < points.size(); ++i)
      spline->knots.push_back(spline->knots.back() +
                              (points[i] - points[i - 1]).norm());
    find_slopes(*spline);
    return {[spline](const double s) { return spline->point(s); },
            [spline](const double s) { return spline->derivative(s); },
            static_cast<unsigned int>(8 * points.size())};
  }



  CenterLine
  divide(const Curve &curve, const unsigned int n_nodes)
  {
    const Lengths lengths(curve, std::max(curve.n_pieces, 4 * n_nodes));
    const double  length = lengths.length.back();
    double        size   = 0;
    for (const double s : {0., .5, 1.})
      size = std::max(size, curve.point(s).norm());
    if (!(length > 1e-12 * size))
      throw InputError("it has no length; allowed: a curve that depends on s");

    CenterLine line;
    for (unsigned int n = 0; n < n_nodes; ++n)
      {
        const double  s     = lengths.parameter(n / (n_nodes - 1.));
        const Vector3 slope = curve.derivative(s);
        if (!(slope.norm() > 1e-6 * length))
          throw InputError("it stands still at s = " + exact_text(s) +
                           "; allowed: curves that go on everywhere");
        line.nodes.push_back(curve.point(s));
        line.tangents.push_back(slope.normalized());
        // the chord of a right angle is .9 of its arc
        if (n > 0 && (line.nodes[n] - line.nodes[n - 1]).norm() <
                       .9 * length / (n_nodes - 1))
          fail_to_turn(n);
      }
    check_turns(line);
    return line;
  }



  CenterLine
  divide(const Polyline &points, const unsigned int n_nodes)
  {
    std::vector<double> length(1, 0.);
    for (std::size_t i = 1; i < points.size(); ++i)
      length.push_back(length.back() + (points[i] - points[i - 1]).norm());

    CenterLine  line;
    std::size_t piece = 1;
    for (unsigned int n = 0; n < n_nodes; ++n)
      {
        const double s = length.back() * n / (n_nodes - 1);
        while (piece + 1 < points.size() && s > length[piece])
          ++piece;
        const double part =
          (s - length[piece - 1]) / (length[piece] - length[piece - 1]);
        line.nodes.push_back((1 - part) * points[piece - 1] +
                             part * points[piece]);
      }

    const std::vector<Vector3> &x    = line.nodes;
    const std::size_t           last = n_nodes - 1;
    line.tangents.resize(n_nodes);
    line.tangents[0] = 4 * x[1] - 3 * x[0] - x[2];
    for (std::size_t n = 1; n < last; ++n)
      line.tangents[n] = x[n + 1] - x[n - 1];
    line.tangents[last] = 3 * x[last] - 4 * x[last - 1] + x[last - 2];

    const double step = (x[1] - x[0]).norm();
    for (Vector3 &tangent : line.tangents)
      {
        if (!(tangent.norm() > 1e-3 * step))
          throw InputError(
            "it folds back on itself; allowed: bends of less than a half "
            "turn, with enough elements");
        tangent.normalize();
      }
    check_turns(line);
    return line;
  }
} // namespace fiberloom
