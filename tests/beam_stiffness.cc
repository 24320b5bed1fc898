// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// Axial, bending and torsional stiffness and the deflection of a cantilever
// over those of beam theory, 1 whatever Poisson's ratio and however slender the
// elements: no Poisson, shear or membrane locking. Transverse contraction. The
// exact law of uniaxial tension at finite strain.

#include <cstdio>
#include <fstream>

#include "checks.h"
#include "dense_beams.h"
#include "sample_fibers.h"

using namespace fiberloom;

namespace
{
  constexpr double A = M_PI, I = M_PI / 4; // radius 1, modulus 1

  struct Ratios
  {
    double tension, contraction, bending, torsion, cantilever;
  };

  /** A fiber along x, its first section vector along z, the second along -y. */
  Ratios
  measure(const double       poisson_ratio,
          const double       element_length,
          const unsigned int n_elements)
  {
    const double    L = element_length * n_elements;
    const double    G = 1 / (2 * (1 + poisson_ratio));
    const FiberMesh mesh(loose_fibers({straight_fiber(
      Vector3::Zero(), Vector3(L, 0, 0), n_elements, poisson_ratio)}));
    Eigen::VectorXd residual;
    Eigen::MatrixXd tangent;
    assemble_dense(mesh, mesh.reference(), residual, tangent);

    // Clamped but for the lengths of the section vectors.
    const std::vector<unsigned int> clamp{0, 1, 2, 3, 4, 6, 8};
    const unsigned int              tip = mesh.reference().size() - 9;
    const auto response = [&](const std::vector<std::pair<int, double>> &load) {
      Eigen::VectorXd force = Eigen::VectorXd::Zero(mesh.reference().size());
      for (const auto &[dof, value] : load)
        force[tip + dof] = value;
      return solve_dense(tangent, force, clamp);
    };

    Ratios                ratios;
    const Eigen::VectorXd tension = response({{0, 1.}});
    ratios.tension                = tension[tip] * A / L;
    ratios.contraction            = -tension[tip + 5] / (tension[tip] / L);
    // Forces on the ends of section vectors that make a unit moment.
    ratios.bending              = response({{3, 1.}})[tip + 3] * I / L;
    const Eigen::VectorXd twist = response({{4, -.5}, {8, -.5}});
    ratios.torsion              = -twist[tip + 4] * G * 2 * I / L;
    ratios.cantilever =
      response({{2, 1.}})[tip + 2] / (L * L * L / (3 * I) + L / (G * A));
    return ratios;
  }

  /**
   * The section stiffness that the three-dimensional law alone gives: its
   * integral over the disc with every strain seen by the whole law.
   */
  SectionStiffness::Matrix
  uncured_section(const double poisson_ratio)
  {
    const double G      = 1 / (2 * (1 + poisson_ratio));
    const double lambda = 2 * G * poisson_ratio / (1 - 2 * poisson_ratio);

    SectionStiffness::Matrix D       = SectionStiffness::Matrix::Zero();
    const unsigned int       n_radii = 200, n_angles = 12;
    for (unsigned int p = 0; p < n_radii; ++p)
      for (unsigned int n = 0; n < n_angles; ++n)
        {
          const double rho   = (p + .5) / n_radii,
                       angle = 2 * M_PI * n / n_angles;
          const double z1 = rho * std::cos(angle), z2 = rho * std::sin(angle);
          // rows 11, 22, 33, 2*12, 2*13, 2*23
          Eigen::Matrix<double, 6, 15> strain =
            Eigen::Matrix<double, 6, 15>::Zero();
          strain(0, 0) = strain(1, 1) = strain(2, 2) = strain(3, 5) = 1;
          strain.row(2).tail<3>() << z1, z2, z1 * z2;
          strain(2, 3) = z1 * z1;
          strain(2, 4) = z2 * z2;
          strain.block<1, 3>(4, 6) << 1, z1, z2;
          strain.block<1, 3>(5, 9) << 1, z1, z2;
          Eigen::Matrix<double, 6, 6> law = Eigen::Matrix<double, 6, 6>::Zero();
          law.topLeftCorner<3, 3>().setConstant(lambda);
          law.diagonal() << lambda + 2 * G, lambda + 2 * G, lambda + 2 * G, G,
            G, G;
          D += rho / n_radii * 2 * M_PI / n_angles * strain.transpose() * law *
               strain;
        }
    return D;
  }

  /** Bending stiffness over EI, all strains free that are linear in the dofs.
   */
  double
  bending_ratio(const SectionStiffness::Matrix &D)
  {
    Eigen::Matrix<double, 12, 12>      linear; // without 44, 55, 45
    const std::array<unsigned int, 12> rows{
      {0, 1, 2, 5, 6, 7, 8, 9, 10, 11, 12, 13}};
    for (unsigned int i = 0; i < 12; ++i)
      for (unsigned int j = 0; j < 12; ++j)
        linear(i, j) = D(rows[i], rows[j]);
    return 1 / (linear.inverse()(10, 10) * I);
  }

  /** Force and section stretch of a uniform stretch with a stress-free border.
   */
  void
  check_uniaxial(Checks &checks)
  {
    const double    stretch = 1.1, poisson_ratio = .3, L = 3;
    const FiberMesh mesh(loose_fibers(
      {straight_fiber(Vector3::Zero(), Vector3(L, 0, 0), 1, poisson_ratio)}));
    const double    section =
      std::sqrt(1 - poisson_ratio * (stretch * stretch - 1));
    DofVector q = section * mesh.reference();
    for (const unsigned int node : {0, 1, 2})
      q[9 * node] *= stretch / section;

    BeamElement::Vector residual;
    mesh.element(0).residual(q, residual);
    const double force = A * stretch * (stretch * stretch - 1) / 2;
    checks.below("uniaxial: tip force", residual[18] / force - 1, 1e-12);
    checks.below("uniaxial: section force",
                 mesh.element(0).section_forces(q, 1).force[0] / force - 1,
                 1e-12);
    residual[0] = residual[18] = 0;
    checks.below("uniaxial: rest", residual.norm(), 1e-12);

    const BeamElement linear(
      mesh.reference(), 1, 1, poisson_ratio, AxialLaw::linear);
    linear.residual(q, residual);
    checks.below("uniaxial, linear: tip force",
                 residual[18] / (A * (stretch - 1)) - 1,
                 1e-12);
    checks.below("uniaxial, linear: section force",
                 linear.section_forces(q, 1).force[0] / (A * (stretch - 1)) - 1,
                 1e-12);
  }
} // namespace

int
main()
{
  std::ofstream output("output");
  Checks        checks(output);
  char          line[200];
  output << "nu, L/r, elements: tension, error of contraction, bending, "
            "torsion, cantilever"
         << std::endl;
  for (const double poisson_ratio : {0., .3, .45})
    for (const unsigned int n : {1, 3})
      for (const double slenderness : {2., 10., 100.})
        {
          const Ratios r = measure(poisson_ratio, slenderness, n);
          std::snprintf(line,
                        sizeof(line),
                        "%.2f %3.0f %u: %.7f %.7f %.7f %.7f %.7f",
                        poisson_ratio,
                        slenderness,
                        n,
                        r.tension,
                        std::abs(r.contraction - poisson_ratio),
                        r.bending,
                        r.torsion,
                        r.cantilever);
          output << line << std::endl;
        }

  for (const double nu : {0., .2, .3, .45})
    {
      const double      locked = bending_ratio(uncured_section(nu));
      const std::string name   = "nu " + std::to_string(nu);
      checks.below(name + ": bending of the section",
                   bending_ratio(SectionStiffness::straight(1, 1, nu)) - 1,
                   1e-12);
      checks.below(name + ": the locking that the cure takes away",
                   locked / ((1 - nu) / ((1 + nu) * (1 - 2 * nu))) - 1,
                   1e-4);
    }
  check_uniaxial(checks);
}
