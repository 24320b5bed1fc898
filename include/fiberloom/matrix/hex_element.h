// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_matrix_hex_element_h
#define fiberloom_matrix_hex_element_h

#include <fiberloom/matrix/hyperelastic_law.h>

#include <vector>

namespace fiberloom
{
  /**
   * A hexahedron of the matrix in a total Lagrangian formulation: with the
   * gradients of the shape functions in the stress-free placement, which are
   * given, F = sum_a x_a (x) dN_a/dX; energy = int W(F) dV, residual r_a = int
   * F S dN_a/dX dV, tangent = int B^T D B + dN_a/dX . S dN_b/dX 1 dV. Node
   * positions come one after the other, three components each. Section 6.2 of
   * the theory.
   */
  class HexElement
  {
  public:
    /** n nodes by three: one matrix a quadrature point [1/mm]. */
    using Gradients = Eigen::Matrix<double, Eigen::Dynamic, 3>;

    /** @p volumes that the quadrature points stand for [mm^3]. */
    HexElement(std::vector<Gradients> gradients,
               std::vector<double>    volumes,
               const HyperelasticLaw &law);

    unsigned int
    n_nodes() const
    {
      return gradients.front().rows();
    }

    /**
     * Deformation gradient, 3 x 3, at quadrature point number @p point where
     * the nodes are at @p x .
     */
    Matrix3
    deformation_gradient(const Eigen::VectorXd &x,
                         const unsigned int     point) const;

    double
    energy(const Eigen::VectorXd &x) const; // [N mm]

    /**
     * Gradient of the energy at the node positions @p x [N], three entries a
     * node; infinite where an element is turned inside out.
     */
    Eigen::VectorXd
    residual(const Eigen::VectorXd &x) const;

    /**
     * Gradient [N] and Hessian [N/mm] of the energy at @p x , with three rows
     * and columns a node.
     */
    void
    residual_and_tangent(const Eigen::VectorXd &x,
                         Eigen::VectorXd       &residual,
                         Eigen::MatrixXd       &tangent) const;

  private:
    std::vector<Gradients> gradients;
    std::vector<double>    volumes;
    HyperelasticLaw        law;
  };
} // namespace fiberloom

#endif
