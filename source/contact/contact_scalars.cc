// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/contact/contact_scalars.h>

#include <cmath>

namespace fiberloom
{
  namespace
  {
    /** Adds the support of one section. */
    void
    subtract_support(const Vector6 &scalars, const unsigned int fiber, Gap &gap)
    {
      const unsigned int support = fiber == 0 ? support_1 : support_2,
                         along   = fiber == 0 ? along_1 : along_2;
      const double a = scalars[support], d = scalars[along],
                   e  = scalars[distance_2] - d * d;
      const double h  = std::sqrt(a / e);
      const double ha = h / (2 * a), he = -h / (2 * e);
      const double haa = -h / (4 * a * a), hae = -h / (4 * a * e),
                   hee = 3 * h / (4 * e * e);
      gap.value -= h;
      gap.gradient[support] -= ha;
      gap.gradient[distance_2] -= he;
      gap.gradient[along] += 2 * d * he;
      const auto add =
        [&gap](const unsigned int i, const unsigned int j, const double value) {
          gap.hessian(i, j) += value;
          if (i != j)
            gap.hessian(j, i) += value;
        };
      add(support, support, -haa);
      add(support, distance_2, -hae);
      add(support, along, 2 * d * hae);
      add(distance_2, distance_2, -hee);
      add(distance_2, along, 2 * d * hee);
      add(along, along, -4 * d * d * hee + 2 * he);
    }

    Matrix3
    cross(const Vector3 &v)
    {
      Matrix3 m;
      m << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
      return m;
    }

    // Variables: d, then r g1 and r g2 of the first, then of the second fiber.
    constexpr unsigned int
    vector_of(const unsigned int fiber, const unsigned int k)
    {
      return 3 + 6 * fiber + 3 * k;
    }

    /** Derivatives by the axes, which are bilinear in the section vectors. */
    void
    set_by_axis(const Configuration          &c,
                const unsigned int            fiber,
                const Vector3                &slope,
                const Scalar                  scalar,
                Eigen::Matrix<double, 6, 15> &jacobian)
    {
      jacobian.block<1, 3>(scalar, vector_of(fiber, 0)) =
        c.g[fiber][1].cross(slope).transpose();
      jacobian.block<1, 3>(scalar, vector_of(fiber, 1)) =
        slope.cross(c.g[fiber][0]).transpose();
    }
  } // namespace



  double
  gap_of(const Vector6 &s, const double sign, const double offset)
  {
    return sign * std::sqrt(s[distance_2]) -
           std::sqrt(s[support_1] / (s[distance_2] - s[along_1] * s[along_1])) -
           std::sqrt(s[support_2] / (s[distance_2] - s[along_2] * s[along_2])) +
           offset;
  }



  Gap
  gap_with_derivatives(const Vector6 &scalars,
                       const double   sign,
                       const double   offset)
  {
    const double distance = std::sqrt(scalars[distance_2]);
    Gap gap{sign * distance + offset, Vector6::Zero(), Matrix6::Zero()};
    gap.gradient[distance_2] = sign * .5 / distance;
    gap.hessian(distance_2, distance_2) =
      -sign * .25 / (distance * scalars[distance_2]);
    subtract_support(scalars, 0, gap);
    subtract_support(scalars, 1, gap);
    return gap;
  }



  Eigen::Matrix<double, 6, 15>
  jacobian_of(const Configuration &c)
  {
    Eigen::Matrix<double, 6, 15> jacobian;
    jacobian.setZero();
    jacobian.block<1, 3>(distance_2, 0) = 2 * c.d.transpose();
    for (unsigned int s = 0; s < 2; ++s)
      {
        const unsigned int support = support_1 + s, along = along_1 + s;
        jacobian.block<1, 3>(support, 0) =
          2 * (c.a[s][0] * c.g[s][0] + c.a[s][1] * c.g[s][1]).transpose();
        for (unsigned int k = 0; k < 2; ++k)
          jacobian.block<1, 3>(support, vector_of(s, k)) =
            2 * c.a[s][k] * c.d.transpose();
        jacobian.block<1, 3>(along, 0) = c.t[s].transpose();
        const Vector3 across           = c.d - c.scalars[along] * c.t[s];
        set_by_axis(c, s, across / c.length[s], Scalar(along), jacobian);
        const Vector3 other = c.t[1 - s] - c.scalars[cosine] * c.t[s];
        set_by_axis(c, s, other / c.length[s], cosine, jacobian);
      }
    return jacobian;
  }



  void
  add_second_derivatives(const Configuration &c,
                         const Vector6       &factor,
                         Matrix15            &hessian)
  {
    hessian.block<3, 3>(0, 0).diagonal().array() += 2 * factor[distance_2];
    std::array<Matrix3, 2> maps[2]; // of the section vectors to the axis
    std::array<Matrix3, 2> projections;
    for (unsigned int s = 0; s < 2; ++s)
      {
        maps[s]        = {{-cross(c.g[s][1]), cross(c.g[s][0])}};
        projections[s] = Matrix3::Identity() - c.t[s] * c.t[s].transpose();
      }
    for (unsigned int s = 0; s < 2; ++s)
      {
        const double fs = 2 * factor[support_1 + s];
        const double fa = factor[along_1 + s], fc = factor[cosine];
        const double along = c.scalars[along_1 + s], cos = c.scalars[cosine],
                     length = c.length[s];
        const Vector3 &t    = c.t[s];
        const auto     add  = [&hessian](const unsigned int i,
                                    const unsigned int j,
                                    const Matrix3     &value) {
          hessian.block<3, 3>(i, j) += value;
          if (i != j)
            hessian.block<3, 3>(j, i) += value.transpose();
        };
        for (unsigned int k = 0; k < 2; ++k)
          {
            hessian.block<3, 3>(0, 0) += fs * c.g[s][k] * c.g[s][k].transpose();
            add(0,
                vector_of(s, k),
                fs * (c.g[s][k] * c.d.transpose() +
                      c.a[s][k] * Matrix3::Identity()));
            add(vector_of(s, k), vector_of(s, k), fs * c.d * c.d.transpose());
          }

        // By the axis n: d.n/|n| and, with the other axis, the cosine.
        const Vector3 m = c.d - along * t, p = c.t[1 - s] - cos * t;
        const Matrix3 by_axis =
          -(fa *
              (t * m.transpose() + m * t.transpose() + along * projections[s]) +
            fc *
              (t * p.transpose() + p * t.transpose() + cos * projections[s])) /
          (length * length);
        const Vector3 slope = (fa * m + fc * p) / length;
        for (unsigned int k = 0; k < 2; ++k)
          {
            add(0, vector_of(s, k), fa / length * projections[s] * maps[s][k]);
            for (unsigned int l = k; l < 2; ++l)
              {
                Matrix3 block = maps[s][k].transpose() * by_axis * maps[s][l];
                if (k != l)
                  block -= cross(slope);
                add(vector_of(s, k), vector_of(s, l), block);
              }
          }
      }
    const Matrix3 mixed = factor[cosine] * projections[0] * projections[1] /
                          (c.length[0] * c.length[1]);
    if (factor[cosine] != 0)
      for (unsigned int k = 0; k < 2; ++k)
        for (unsigned int l = 0; l < 2; ++l)
          {
            const Matrix3 block = maps[0][k].transpose() * mixed * maps[1][l];
            hessian.block<3, 3>(vector_of(0, k), vector_of(1, l)) += block;
            hessian.block<3, 3>(vector_of(1, l), vector_of(0, k)) +=
              block.transpose();
          }
  }
} // namespace fiberloom
