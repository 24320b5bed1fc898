// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_contact_contact_scalars_h
#define fiberloom_contact_contact_scalars_h

#include <fiberloom/contact/contact_law.h>
#include <fiberloom/contact/fiber_point.h>

#include <array>

namespace fiberloom
{
  using Vector6  = Eigen::Matrix<double, 6, 1>;
  using Matrix6  = Eigen::Matrix<double, 6, 6>;
  using Vector15 = Eigen::Matrix<double, 15, 1>;
  using Matrix15 = Eigen::Matrix<double, 15, 15>;

  /** What the energy depends on: d.d, for each fiber (d.r g1)^2 + (d.r g2)^2
   * and d.t, and the cosine of the angle of the fibers. */
  enum Scalar
  {
    distance_2,
    support_1,
    support_2,
    along_1,
    along_2,
    cosine
  };

  /** Scalars of two points, with what their derivatives are made of. */
  struct Configuration
  {
    Vector3                               d;
    std::array<Vector3, 2>                n, t;
    std::array<double, 2>                 length;
    std::array<std::array<Vector3, 2>, 2> g;
    std::array<std::array<double, 2>, 2>  a;
    Vector6                               scalars;

    explicit Configuration(const PointPair &points)
      : d(points[0].center() - points[1].center())
    {
      scalars[distance_2] = d.squaredNorm();
      for (unsigned int s = 0; s < 2; ++s)
        {
          n[s]      = points[s].axis();
          length[s] = n[s].norm();
          t[s]      = n[s] / length[s];
          for (unsigned int k = 0; k < 2; ++k)
            {
              g[s][k] = points[s].vector(k);
              a[s][k] = d.dot(g[s][k]);
            }
          scalars[support_1 + s] = a[s][0] * a[s][0] + a[s][1] * a[s][1];
          scalars[along_1 + s]   = d.dot(t[s]);
        }
      scalars[cosine] = t[0].dot(t[1]);
    }

    /**
     * 1 where the fibers are on the sides of each other on which they belong,
     * else -1.
     */
    double
    sign(const ContactElement &contact) const
    {
      return contact.following == ContactElement::Points::closest &&
                 contact.orientation * d.dot(t[0].cross(t[1])) < 0 ?
               -1 :
               1;
    }
  };

  /** Gap with derivatives by the scalars. */
  struct Gap
  {
    double  value;
    Vector6 gradient;
    Matrix6 hessian;
  };

  /**
   * Gap that follows from @p scalars [mm]; @p sign as Configuration::sign(),
   * @p offset as in ContactElement.
   */
  double
  gap_of(const Vector6 &scalars, const double sign, const double offset);

  /** The same with its derivatives by the scalars. */
  Gap
  gap_with_derivatives(const Vector6 &scalars,
                       const double   sign,
                       const double   offset);

  /** crossing_spread() with derivatives by the cosine. */
  struct Spread
  {
    double value, first, second;

    Spread(const ContactElement &contact, const double cosine)
      : value(crossing_spread(cosine, contact.radii))
    {
      const auto [c, c1, c2] = acute_cosine(cosine);
      const double l         = 1 / (1 - c * c); // derivative of its logarithm
      first                  = value * l * c1;
      second                 = value * l * (l * (1 + 2 * c) * c1 * c1 + c2);
    }
  };

  /**
   * Derivatives of the six scalars, one a row, by d, then r g1 and r g2 of the
   * first, then of the second fiber: 6 x 15.
   */
  Eigen::Matrix<double, 6, 15>
  jacobian_of(const Configuration &c);

  /** Adds the second derivatives of the scalars, each times its @p factor . */
  void
  add_second_derivatives(const Configuration &c,
                         const Vector6       &factor,
                         Matrix15            &hessian);
} // namespace fiberloom

#endif
