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
  /**
   * A point of a fiber: the nine components x = (x0, r g1, r g2) of the section
   * there [mm], as in SectionPair, and their first and second derivatives by
   * the parameter u of FiberMesh [mm]. They follow from the shape functions of
   * contact, see LineWeights, so that they are continuous over element borders.
   */
  struct FiberPoint
  {
    LineWeights                 weights;
    Eigen::Matrix<double, 9, 1> x, slope, second;

    /**
     * The point of the fiber @p line at the parameter @p u where the dofs of
     * all nodes are @p q .
     */
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

    /** Point of the centre line, x0 [mm]. */
    Vector3
    center() const
    {
      return x.head<3>();
    }

    /** Section vector r g1 ( @p k = 0) or r g2 ( @p k = 1) [mm]. */
    Vector3
    vector(const unsigned int k) const
    {
      return x.segment<3>(3 + 3 * k);
    }

    /**
     * r g1 x r g2, which is across the section and not of unit length [mm^2].
     */
    Vector3
    axis() const
    {
      return vector(0).cross(vector(1));
    }

    /** Derivative of axis() by u [mm^2]. */
    Vector3
    axis_slope() const
    {
      return slope.segment<3>(3).cross(vector(1)) +
             vector(0).cross(slope.segment<3>(6));
    }

    /** Unit vector across the section. */
    Vector3
    tangent() const
    {
      return axis().normalized();
    }

    /** Derivative of tangent() by u. */
    Vector3
    tangent_slope() const
    {
      const double  length = axis().norm();
      const Vector3 t = axis() / length, change = axis_slope();
      return (change - t * t.dot(change)) / length;
    }
  };

  /** The two points of a contact, in the order of its fibers. */
  using PointPair = std::array<FiberPoint, 2>;

  /**
   * The two points of @p contact where the dofs of the fibers are @p q . They
   * are moved as ContactElement::following says, on the plane across the
   * intermediate geometry or to where the fibers are closest, by Newton's
   * method in u, and stored in @p contact . Where they are not found,
   * @p contact is marked as lost.
   */
  PointPair
  followed_points(ContactElement  &contact,
                  const FiberMesh &mesh,
                  const DofVector &q);
} // namespace fiberloom

#endif
