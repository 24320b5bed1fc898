// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>

#include <fiberloom/beams/section_stiffness.h>

#include <deal.II/base/quadrature_lib.h>

#include <Eigen/Dense>

#include <cmath>

namespace fiberloom
{
  namespace
  {
    using StrainMap = Eigen::Matrix<double, 6, SectionStiffness::n_strains>;
    using Matrix6   = Eigen::Matrix<double, 6, 6>;

    Matrix6
    isotropic_law(const double young_modulus, const double poisson_ratio)
    {
      const double G      = young_modulus / (2 * (1 + poisson_ratio));
      const double lambda = 2 * G * poisson_ratio / (1 - 2 * poisson_ratio);

      Matrix6 D               = Matrix6::Zero();
      D.topLeftCorner<3, 3>() = Matrix3::Constant(lambda);
      D.diagonal().head<3>()  = Vector3::Constant(lambda + 2 * G);
      D.diagonal().tail<3>()  = Vector3::Constant(G);
      return D;
    }

    /**
     * Physical strain (11, 22, 33, 2*12, 2*13, 2*23 along an orthonormal
     * frame) at (z1, z2) per generalised strain, for the reference basis
     * @p basis (columns G1, G2, G3 at that point in the same frame).
     */
    StrainMap
    physical_strain(const double z1, const double z2, const Matrix3 &basis)
    {
      // Covariant components: rows 11, 22, 33, 12, 13, 23 of E_ij.
      StrainMap covariant = StrainMap::Zero();
      covariant(0, 0)     = 1;
      covariant(1, 1)     = 1;
      covariant(2, 2)     = 1;
      covariant(2, 3)     = z1 * z1;
      covariant(2, 4)     = z2 * z2;
      covariant(2, 12)    = z1;
      covariant(2, 13)    = z2;
      covariant(2, 14)    = z1 * z2;
      covariant(3, 5)     = .5;
      for (const unsigned int row : {4, 5})
        {
          const unsigned int first  = (row == 4) ? 6 : 9;
          covariant(row, first)     = .5;
          covariant(row, first + 1) = .5 * z1;
          covariant(row, first + 2) = .5 * z2;
        }

      const Matrix3          contravariant = basis.inverse(); // rows G^i
      constexpr unsigned int index[6][2]   = {
          {0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
      Matrix6 transformation;
      for (unsigned int physical = 0; physical < 6; ++physical)
        for (unsigned int component = 0; component < 6; ++component)
          {
            const auto [a, b] = index[physical];
            const auto [i, j] = index[component];
            double value      = contravariant(i, a) * contravariant(j, b);
            if (i != j)
              value += contravariant(j, a) * contravariant(i, b);
            transformation(physical, component) =
              (physical < 3 ? 1. : 2.) * value;
          }
      return transformation * covariant;
    }
  } // namespace



  SectionStiffness::Matrix
  SectionStiffness::straight(const double r,
                             const double E,
                             const double poisson_ratio)
  {
    const double G      = E / (2 * (1 + poisson_ratio));
    const double lambda = 2 * G * poisson_ratio / (1 - 2 * poisson_ratio);
    const double Lambda = lambda + 2 * G;
    const double A      = M_PI * r * r;
    const double I      = A * r * r / 4;
    const double M      = M_PI * std::pow(r, 6) / 16;

    Matrix                      D = Matrix::Zero();
    Eigen::Matrix<double, 5, 5> P;
    P.topLeftCorner<3, 3>() = Matrix3::Constant(A * lambda);
    P.diagonal().head<3>()  = Vector3::Constant(A * Lambda);
    P.topRightCorner<3, 2>() << I * lambda, I * lambda, I * lambda, I * lambda,
      I * Lambda, I * Lambda;
    P.bottomLeftCorner<2, 3>() = P.topRightCorner<3, 2>().transpose();
    P(3, 3) = P(4, 4) = (Lambda + E) * M;
    P(3, 4) = P(4, 3)       = (Lambda - E / 3) * M;
    D.topLeftCorner<5, 5>() = P;

    D.diagonal().tail<10>() << G * A, G * A, G * I, G * I, G * A, G * I, G * I,
      E * I, E * I, E * M_PI * std::pow(r, 6) / 24;
    return D;
  }



  SectionStiffness::Matrix
  SectionStiffness::curved(const std::array<Vector3, 5> &q,
                           const double                  radius,
                           const double                  young_modulus,
                           const double                  poisson_ratio)
  {
    // An orthonormal frame from the section vectors, in which the law is read.
    Matrix3 frame;
    frame.col(0) = q[0].normalized();
    frame.col(2) = q[0].cross(q[1]).normalized();
    frame.col(1) = frame.col(2).cross(frame.col(0));

    constexpr unsigned int  n_angles = 12;
    const dealii::QGauss<1> radial(5);

    std::vector<StrainMap> maps;
    std::vector<double>    volumes;
    StrainMap              average = StrainMap::Zero();
    double                 volume  = 0;
    for (unsigned int p = 0; p < radial.size(); ++p)
      for (unsigned int n = 0; n < n_angles; ++n)
        {
          const double rho   = radius * radial.point(p)[0];
          const double angle = 2 * M_PI * n / n_angles;
          const double z1 = rho * std::cos(angle), z2 = rho * std::sin(angle);

          Matrix3 basis;
          basis.col(0) = frame.transpose() * q[0];
          basis.col(1) = frame.transpose() * q[1];
          basis.col(2) = frame.transpose() * (q[2] + z1 * q[3] + z2 * q[4]);
          const double jacobian = basis.determinant();
          if (!(jacobian > 0))
            throw InputError("a fiber is bent more sharply than its radius "
                             "allows: its section reaches the centre of "
                             "curvature");

          maps.push_back(physical_strain(z1, z2, basis));
          volumes.push_back(jacobian * rho * radial.weight(p) * radius * 2 *
                            M_PI / n_angles);
          average += volumes.back() * maps.back();
          volume += volumes.back();
        }
    average /= volume;

    const Matrix6 D               = isotropic_law(young_modulus, poisson_ratio);
    Matrix6       fluctuation_law = D;
    fluctuation_law.topLeftCorner<3, 3>() = young_modulus * Matrix3::Identity();

    Matrix stiffness = volume * average.transpose() * D * average;
    for (unsigned int n = 0; n < maps.size(); ++n)
      {
        const StrainMap fluctuation = maps[n] - average;
        stiffness +=
          volumes[n] * fluctuation.transpose() * fluctuation_law * fluctuation;
      }
    return stiffness;
  }
} // namespace fiberloom
