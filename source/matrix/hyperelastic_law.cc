// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/matrix/hyperelastic_law.h>

#include <Eigen/LU>

#include <array>
#include <cmath>
#include <limits>

namespace fiberloom
{
  namespace
  {
    constexpr std::array<std::array<unsigned int, 2>, 6> voigt_indices{
      {{{0, 0}}, {{1, 1}}, {{2, 2}}, {{0, 1}}, {{1, 2}}, {{0, 2}}}};

    Voigt
    unit_tensor()
    {
      Voigt unit;
      unit << 1, 1, 1, 0, 0, 0;
      return unit;
    }

    Voigt
    components(const Matrix3 &tensor)
    {
      Voigt result;
      for (unsigned int a = 0; a < 6; ++a)
        result[a] = tensor(voigt_indices[a][0], voigt_indices[a][1]);
      return result;
    }
  } // namespace



  HyperelasticLaw::HyperelasticLaw(const MatrixLaw type,
                                   const double    young_modulus,
                                   const double    poisson_ratio)
    : law(type)
    , lambda(young_modulus * poisson_ratio /
             ((1 + poisson_ratio) * (1 - 2 * poisson_ratio)))
    , mu(young_modulus / (2 * (1 + poisson_ratio)))
  {}



  double
  HyperelasticLaw::energy(const Matrix3 &F) const
  {
    if (law == MatrixLaw::saint_venant_kirchhoff)
      {
        const Voigt  E     = green_lagrange_strain(F);
        const double trace = E.head<3>().sum();
        return .5 * lambda * trace * trace +
               mu *
                 (E.head<3>().squaredNorm() + .5 * E.tail<3>().squaredNorm());
      }
    const double J = F.determinant();
    if (!(J > 0))
      return std::numeric_limits<double>::infinity();
    const double log_J = std::log(J);
    // tr C - 3 = 2 tr E, without the loss of digits where nothing is strained
    return mu * (green_lagrange_strain(F).head<3>().sum() - log_J) +
           .5 * lambda * log_J * log_J;
  }



  Voigt
  HyperelasticLaw::stress(const Matrix3 &F) const
  {
    if (law == MatrixLaw::saint_venant_kirchhoff)
      {
        const Voigt E = green_lagrange_strain(F);
        Voigt       S = lambda * E.head<3>().sum() * unit_tensor();
        S.head<3>() += 2 * mu * E.head<3>();
        S.tail<3>() += mu * E.tail<3>();
        return S;
      }
    const double J = F.determinant();
    if (!(J > 0))
      return Voigt::Constant(std::numeric_limits<double>::infinity());
    const Voigt inverse = components((F.transpose() * F).inverse());
    return mu * (unit_tensor() - inverse) + lambda * std::log(J) * inverse;
  }



  Voigt2
  HyperelasticLaw::stiffness(const Matrix3 &F) const
  {
    Voigt2 D = Voigt2::Zero();
    if (law == MatrixLaw::saint_venant_kirchhoff)
      {
        D.topLeftCorner<3, 3>().setConstant(lambda);
        D.diagonal() << lambda + 2 * mu, lambda + 2 * mu, lambda + 2 * mu, mu,
          mu, mu;
        return D;
      }
    const Matrix3 inverse = (F.transpose() * F).inverse();
    const double  shear   = mu - lambda * std::log(F.determinant());
    for (unsigned int a = 0; a < 6; ++a)
      for (unsigned int b = 0; b < 6; ++b)
        {
          const auto [i, j] = voigt_indices[a];
          const auto [k, l] = voigt_indices[b];
          D(a, b)           = lambda * inverse(i, j) * inverse(k, l) +
                    shear * (inverse(i, k) * inverse(j, l) +
                             inverse(i, l) * inverse(j, k));
        }
    return D;
  }



  Voigt
  green_lagrange_strain(const Matrix3 &F)
  {
    Voigt strain = components(.5 * (F.transpose() * F - Matrix3::Identity()));
    strain.tail<3>() *= 2;
    return strain;
  }



  Matrix3
  symmetric_matrix(const Voigt &components)
  {
    Matrix3 tensor;
    for (unsigned int a = 0; a < 6; ++a)
      tensor(voigt_indices[a][0], voigt_indices[a][1]) =
        tensor(voigt_indices[a][1], voigt_indices[a][0]) = components[a];
    return tensor;
  }
} // namespace fiberloom
