// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_contact_fiber_point_h
#define fiberloom_contact_fiber_point_h

#include <fiberloom/contact/contact_element.h>
#include <fiberloom/contact/line_weights.h>

#include <Eigen/Geometry>

#include <array>

namespace fiberloom
{
  /** A point of a fiber: the section there, as in SectionPair, and its
   * derivatives by u. */
  struct FiberPoint
  {
    LineWeights                 weights;
    Eigen::Matrix<double, 9, 1> x, slope, second;

    FiberPoint(const FiberMesh::Line &line, const DofVector &q, const double u)
      : weights(line, u)
      , x(Eigen::Matrix<double, 9, 1>::Zero())
      , slope(Eigen::Matrix<double, 9, 1>::Zero())
      , second(Eigen::Matrix<double, 9, 1>::Zero())
    {
      for (unsigned int a = 0; a < weights.n; ++a)
        {
          const auto node = q.segment<9>(9 * (weights.first_node + a));
          x += weights.value[a] * node;
          slope += weights.first[a] * node;
          second += weights.second[a] * node;
        }
    }

    Vector3
    center() const
    {
      return x.head<3>();
    }

    Vector3
    vector(const unsigned int k) const
    {
      return x.segment<3>(3 + 3 * k);
    }

    /** Across the section, not of unit length. */
    Vector3
    axis() const
    {
      return vector(0).cross(vector(1));
    }

    Vector3
    axis_slope() const
    {
      return slope.segment<3>(3).cross(vector(1)) +
             vector(0).cross(slope.segment<3>(6));
    }

    Vector3
    tangent() const
    {
      return axis().normalized();
    }

    Vector3
    tangent_slope() const
    {
      const double  length = axis().norm();
      const Vector3 t = axis() / length, change = axis_slope();
      return (change - t * t.dot(change)) / length;
    }
  };

  using PointPair = std::array<FiberPoint, 2>;

  /** The two points of @p contact , moved to where they belong at @p q ; or it
   * is marked as lost. */
  PointPair
  followed_points(ContactElement  &contact,
                  const FiberMesh &mesh,
                  const DofVector &q);
} // namespace fiberloom

#endif
