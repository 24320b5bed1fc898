// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/matrix/hex_element.h>

#include <limits>

namespace fiberloom
{
  namespace
  {
    using Positions = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
    using StrainByNodes = Eigen::Matrix<double, 6, Eigen::Dynamic>;

    /** How the strain, with doubled shear components, follows the nodes. */
    void
    set_strain_by_nodes(const Matrix3               &F,
                        const HexElement::Gradients &dN,
                        StrainByNodes               &B)
    {
      B.resize(6, 3 * dN.rows());
      for (Eigen::Index a = 0; a < dN.rows(); ++a)
        for (unsigned int c = 0; c < 3; ++c)
          {
            const auto f      = F.row(c);
            auto       column = B.col(3 * a + c);
            column[0]         = f[0] * dN(a, 0);
            column[1]         = f[1] * dN(a, 1);
            column[2]         = f[2] * dN(a, 2);
            column[3]         = f[0] * dN(a, 1) + f[1] * dN(a, 0);
            column[4]         = f[1] * dN(a, 2) + f[2] * dN(a, 1);
            column[5]         = f[0] * dN(a, 2) + f[2] * dN(a, 0);
          }
    }
  } // namespace



  HexElement::HexElement(std::vector<Gradients> gradients,
                         std::vector<double>    volumes,
                         const HyperelasticLaw &law)
    : gradients(std::move(gradients))
    , volumes(std::move(volumes))
    , law(law)
  {}



  Matrix3
  HexElement::deformation_gradient(const Eigen::VectorXd &x,
                                   const unsigned int     point) const
  {
    const Eigen::Map<const Positions> nodes(x.data(), n_nodes(), 3);
    return nodes.transpose() * gradients[point];
  }



  double
  HexElement::energy(const Eigen::VectorXd &x) const
  {
    double energy = 0;
    for (unsigned int p = 0; p < volumes.size(); ++p)
      energy += volumes[p] * law.energy(deformation_gradient(x, p));
    return energy;
  }



  Eigen::VectorXd
  HexElement::residual(const Eigen::VectorXd &x) const
  {
    Positions forces = Positions::Zero(n_nodes(), 3);
    for (unsigned int p = 0; p < volumes.size(); ++p)
      {
        const Matrix3 F      = deformation_gradient(x, p);
        const Voigt   stress = law.stress(F);
        if (!stress.allFinite())
          return Eigen::VectorXd::Constant(
            3 * n_nodes(), std::numeric_limits<double>::infinity());
        const Matrix3 FS = volumes[p] * F * symmetric_matrix(stress);
        forces.noalias() += gradients[p] * FS.transpose();
      }
    return Eigen::Map<const Eigen::VectorXd>(forces.data(), forces.size());
  }



  void
  HexElement::residual_and_tangent(const Eigen::VectorXd &x,
                                   Eigen::VectorXd       &residual,
                                   Eigen::MatrixXd       &tangent) const
  {
    const unsigned int n = n_nodes();
    residual             = this->residual(x);
    tangent.setZero(3 * n, 3 * n);
    if (!residual.allFinite())
      return;
    StrainByNodes   B;
    Eigen::MatrixXd geometric;
    for (unsigned int p = 0; p < volumes.size(); ++p)
      {
        const Matrix3 F = deformation_gradient(x, p);
        set_strain_by_nodes(F, gradients[p], B);
        const Voigt2        D  = volumes[p] * law.stiffness(F);
        const StrainByNodes DB = D * B;
        tangent.noalias() += B.transpose() * DB;
        geometric.noalias() = volumes[p] * gradients[p] *
                              symmetric_matrix(law.stress(F)) *
                              gradients[p].transpose();
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int b = 0; b < n; ++b)
            for (unsigned int c = 0; c < 3; ++c)
              tangent(3 * a + c, 3 * b + c) += geometric(a, b);
      }
  }
} // namespace fiberloom
