// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/contact/fiber_point.h>

#include <Eigen/LU>

#include <algorithm>

namespace fiberloom
{
  namespace
  {
    using Points = ContactElement::Points;

    PointPair
    points_of(const ContactElement &contact,
              const FiberMesh      &mesh,
              const DofVector      &q)
    {
      const auto &lines = mesh.lines();
      return {{{lines[contact.fibers[0]], q, contact.u[0]},
               {lines[contact.fibers[1]], q, contact.u[1]}}};
    }

    // Newton's method for the points: steps in u, and when it is found_below or
    // lost.
    constexpr unsigned int most_steps = 40;
    constexpr double longest_step = .5, found_below = 1e-10, lost_beyond = 1e3;
    // Slopes that have changed more than to this part of those of straight
    // fibers are not trusted.
    constexpr double trusted = .1;

    /** The step of a point that stays on the plane across the intermediate
     * geometry. */
    double
    step_on_plane(const PointPair &points, const int orientation)
    {
      const Vector3 d = points[0].center() - points[1].center();
      const Vector3 along =
        points[0].tangent() + orientation * points[1].tangent();
      const double straight = -points[1].slope.head<3>().dot(along);
      const double slope =
        straight + orientation * d.dot(points[1].tangent_slope());
      return -d.dot(along) / (slope * straight > trusted * straight * straight ?
                                slope :
                                straight);
    }

    Eigen::Vector2d
    step_to_closest(const PointPair &points)
    {
      const Vector3 d  = points[0].center() - points[1].center();
      const Vector3 t1 = points[0].tangent(), t2 = points[1].tangent();
      const Vector3 c1 = points[0].slope.head<3>(),
                    c2 = points[1].slope.head<3>();
      Eigen::Matrix2d straight;
      straight << c1.dot(t1), -c2.dot(t1), c1.dot(t2), -c2.dot(t2);
      Eigen::Matrix2d slope = straight;
      slope(0, 0) += d.dot(points[0].tangent_slope());
      slope(1, 1) += d.dot(points[1].tangent_slope());
      if (slope.determinant() * straight.determinant() <
          trusted * straight.determinant() * straight.determinant())
        slope = straight;
      return -(slope.inverse() * Eigen::Vector2d(d.dot(t1), d.dot(t2)));
    }
  } // namespace



  PointPair
  followed_points(ContactElement  &contact,
                  const FiberMesh &mesh,
                  const DofVector &q)
  {
    PointPair points = points_of(contact, mesh, q);
    contact.lost     = false;
    for (unsigned int i = 0; i < most_steps; ++i)
      {
        Eigen::Vector2d step(0, 0);
        if (contact.following == Points::on_plane)
          step[1] = step_on_plane(points, contact.orientation);
        else
          step = step_to_closest(points);
        const double largest = step.lpNorm<Eigen::Infinity>();
        if (!step.allFinite() || largest > lost_beyond)
          break;
        for (unsigned int s = 0; s < 2; ++s)
          contact.u[s] += std::clamp(step[s], -longest_step, longest_step);
        points = points_of(contact, mesh, q);
        if (largest < found_below)
          return points;
      }
    contact.lost = true;
    return points;
  }
} // namespace fiberloom
