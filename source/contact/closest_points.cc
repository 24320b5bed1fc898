// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/contact/closest_points.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace fiberloom
{
  namespace
  {
    constexpr unsigned int largest_iterations = 30;
    constexpr double       tolerance          = 1e-11; // on u

    // A closest point that is so much beyond the end of a fiber, over its
    // radius, is at its end: a fiber that ends on another one crosses it.
    constexpr double beyond_end = .1;

    /**
     * Newton's method on two conditions d . a = d . b = 0 for d = c1 - c2;
     * @p axes gives a and b from the two sections.
     */
    template <class Axes>
    ParameterPair
    solve_pair(const FiberMesh                   &mesh,
               const DofVector                   &q,
               const std::array<unsigned int, 2> &fibers,
               ParameterPair                      u,
               const Axes                        &axes)
    {
      for (unsigned int i = 0; i < largest_iterations; ++i)
        {
          const Section first   = mesh.section(q, mesh.locate(fibers[0], u[0]));
          const Section second  = mesh.section(q, mesh.locate(fibers[1], u[1]));
          const auto [a, b]     = axes(first, second);
          const Vector3 between = first.center - second.center;

          Eigen::Matrix2d jacobian;
          jacobian << first.center_derivative.dot(a),
            -second.center_derivative.dot(a), first.center_derivative.dot(b),
            -second.center_derivative.dot(b);
          const Eigen::Vector2d step =
            jacobian.inverse() *
            Eigen::Vector2d(between.dot(a), between.dot(b));
          if (!step.allFinite())
            break;

          double change = 0;
          for (unsigned int s = 0; s < 2; ++s)
            {
              const double before = u[s];
              const double end    = mesh.lines()[fibers[s]].n_elements;
              // Far off, one element at a time: the lines may curve.
              u[s] =
                std::clamp(before -
                             std::clamp(step[s], -end / 4 - 1, end / 4 + 1),
                           0.,
                           end);
              change = std::max(change, std::abs(u[s] - before));
            }
          if (change < tolerance)
            break;
        }
      return u;
    }
  } // namespace



  SegmentDistance
  segment_distance(const Vector3 &a0,
                   const Vector3 &a1,
                   const Vector3 &b0,
                   const Vector3 &b1)
  {
    const Vector3 u = a1 - a0, v = b1 - b0, w = a0 - b0;
    const double  a = u.squaredNorm(), b = u.dot(v), c = v.squaredNorm();
    const double  d = u.dot(w), e = v.dot(w);
    const double  determinant = a * c - b * b;

    double       s = (determinant > 1e-12 * a * c) ?
                       std::clamp((b * e - c * d) / determinant, 0., 1.) :
                       .5;
    const double t = std::clamp((b * s + e) / c, 0., 1.);
    s              = std::clamp((b * t - d) / a, 0., 1.);
    return {s, t, (w + s * u - t * v).norm()};
  }



  ParameterPair
  mutual_closest_point(const FiberMesh                   &mesh,
                       const DofVector                   &q,
                       const std::array<unsigned int, 2> &fibers,
                       const ParameterPair               &start)
  {
    return solve_pair(
      mesh, q, fibers, start, [](const Section &a, const Section &b) {
        return std::make_pair(a.tangent(), b.tangent());
      });
  }



  std::optional<ParameterPair>
  inner_closest_point(const FiberMesh                   &mesh,
                      const DofVector                   &q,
                      const std::array<unsigned int, 2> &fibers,
                      const ParameterPair               &start)
  {
    const ParameterPair u = mutual_closest_point(mesh, q, fibers, start);
    for (unsigned int s = 0; s < 2; ++s)
      {
        const auto &line     = mesh.lines()[fibers[s]];
        const bool  at_start = u[s] <= 0;
        if (!at_start && u[s] < line.n_elements)
          continue;
        const Section here = mesh.section(q, mesh.locate(fibers[s], u[s])),
                      other =
                        mesh.section(q, mesh.locate(fibers[1 - s], u[1 - s]));
        const double along = (other.center - here.center).dot(here.tangent());
        if ((at_start ? -along : along) > beyond_end * line.radius)
          return {};
      }
    return u;
  }



  ParameterPair
  plan_crossing(const FiberMesh                   &mesh,
                const DofVector                   &q,
                const std::array<unsigned int, 2> &fibers,
                const ParameterPair               &start)
  {
    return solve_pair(
      mesh, q, fibers, start, [](const Section &, const Section &) {
        return std::make_pair(Vector3(Vector3::UnitX()),
                              Vector3(Vector3::UnitY()));
      });
  }



  std::optional<double>
  cut_by_plane(const FiberMesh   &mesh,
               const DofVector   &q,
               const Section     &first,
               const unsigned int fiber,
               const double       start)
  {
    const Vector3 t1  = first.tangent();
    const double  end = mesh.lines()[fiber].n_elements;
    double        u   = start;
    for (unsigned int i = 0; i < largest_iterations; ++i)
      {
        const Section second = mesh.section(q, mesh.locate(fiber, u));
        const Vector3 t2     = second.tangent();
        const Vector3 normal = t1 + (t1.dot(t2) >= 0 ? 1. : -1.) * t2;
        const double  slope  = second.center_derivative.dot(normal);
        const double  step = (first.center - second.center).dot(normal) / slope;
        if (!std::isfinite(step))
          return {};
        const double next = std::clamp(u + std::clamp(step, -1., 1.), 0., end);
        if (std::abs(next - u) < tolerance)
          return u + step; // beyond the end that it is still pushed against
        u = next;
      }
    return u;
  }



  Vector3
  mean_direction(const Vector3 &t1, const Vector3 &t2)
  {
    return (t1 + (t1.dot(t2) >= 0 ? 1. : -1.) * t2).normalized();
  }
} // namespace fiberloom
