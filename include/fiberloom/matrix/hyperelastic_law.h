// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_matrix_hyperelastic_law_h
#define fiberloom_matrix_hyperelastic_law_h

#include <fiberloom/base/choices.h>
#include <fiberloom/base/vector_types.h>

namespace fiberloom
{
  /** Symmetric tensors as components 11, 22, 33, 12, 23, 13. */
  using Voigt  = Eigen::Matrix<double, 6, 1>;
  using Voigt2 = Eigen::Matrix<double, 6, 6>;

  /**
   * An isotropic hyperelastic law: stored energy per reference volume as a
   * function of C = F^T F, its derivatives by the Green-Lagrange strain
   * E = (C - 1) / 2, whose shear components count twice in a Voigt vector.
   *
   * Saint Venant-Kirchhoff: W = lambda/2 (tr E)^2 + mu E:E. Compressible
   * neo-Hooke (Bonet and Wood, Nonlinear Continuum Mechanics for Finite Element
   * Analysis, 2nd edition, section 6.4.3): W = mu/2 (tr C - 3) - mu ln J +
   * lambda/2 (ln J)^2.
   */
  class HyperelasticLaw
  {
  public:
    /** @p young_modulus in MPa. */
    HyperelasticLaw(const MatrixLaw type,
                    const double    young_modulus,
                    const double    poisson_ratio);

    /** Stored energy [MPa]; infinite where J <= 0 . */
    double
    energy(const Matrix3 &F) const;

    /** Second Piola-Kirchhoff stress [MPa]. */
    Voigt
    stress(const Matrix3 &F) const;

    /**
     * Derivative of the stress by the strain with doubled shear components, 6 x
     * 6 [MPa].
     */
    Voigt2
    stiffness(const Matrix3 &F) const;

  private:
    MatrixLaw law;
    double    lambda, mu; // Lame's constants [MPa]
  };

  /** Green-Lagrange strain with doubled shear components. */
  Voigt
  green_lagrange_strain(const Matrix3 &F);

  /** The matrix of the components of a stress. */
  Matrix3
  symmetric_matrix(const Voigt &components);
} // namespace fiberloom

#endif
