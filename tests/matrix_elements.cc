// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// The laws and the cells of the matrix: energy against stress against
// stiffness by differences, the linear limit, an even strain that a distorted
// mesh repeats, rigid motions without forces and no other mode without energy.

#include <fiberloom/matrix/matrix_mesh.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <fstream>

#include "checks.h"

using namespace fiberloom;

namespace
{
  const std::array<const char *, 2> law_names{
    {"Saint Venant-Kirchhoff", "neo-Hooke"}};

  HyperelasticLaw
  law(const std::string &name)
  {
    return {choice_of<MatrixLaw>(name), 3., .3};
  }

  void
  check_law(Checks &checks, const std::string &name)
  {
    const HyperelasticLaw material = law(name);
    std::srand(1);
    const Matrix3 F = Matrix3::Identity() + .3 * Matrix3::Random();

    // Strains as unknowns: the stretch that belongs to them, without rotation.
    const auto stretch = [](const Eigen::VectorXd &strain) {
      Matrix3 C = Matrix3::Identity();
      C.diagonal() += 2 * strain.head<3>();
      C(0, 1) = C(1, 0) = strain[3];
      C(1, 2) = C(2, 1) = strain[4];
      C(0, 2) = C(2, 0) = strain[5];
      return Matrix3(Eigen::SelfAdjointEigenSolver<Matrix3>(C).operatorSqrt());
    };
    const Eigen::VectorXd strain = green_lagrange_strain(F);
    const auto            energy = [&](const Eigen::VectorXd &e) {
      return material.energy(stretch(e));
    };
    const auto stress = [&](const Eigen::VectorXd &e) {
      return Eigen::VectorXd(material.stress(stretch(e)));
    };
    checks.below(name + ": stress by differences",
                 relative_error(difference_gradient(energy, strain, 1e-6),
                                stress(strain)),
                 1e-8);
    checks.below(name + ": stiffness by differences",
                 relative_error(difference_jacobian(stress, strain, 1e-6),
                                material.stiffness(F)),
                 1e-8);
    checks.below(name + ": energy of a turned deformation",
                 material.energy(
                   Eigen::AngleAxisd(2, Vector3(1, 2, 3).normalized()) * F) /
                     material.energy(F) -
                   1,
                 1e-12);

    Voigt2       linear = Voigt2::Zero();
    const double lambda = 3 * .3 / (1.3 * .4), mu = 3 / 2.6;
    linear.topLeftCorner<3, 3>().setConstant(lambda);
    linear.diagonal() << Voigt::Constant(mu);
    linear.diagonal().head<3>().array() += lambda + mu;
    checks.below(name + ": Hooke's law at rest",
                 relative_error(material.stiffness(Matrix3::Identity()),
                                linear),
                 1e-14);
  }

  /** Two by two by two cells with no right angle. */
  LayerGeometry
  distorted_block()
  {
    LayerBlock block;
    block.n_cells = {{2, 2, 2}};
    std::srand(2);
    for (unsigned int k = 0; k < 3; ++k)
      for (unsigned int j = 0; j < 3; ++j)
        for (unsigned int i = 0; i < 3; ++i)
          {
            const Vector3 vertex =
              Vector3(i, 1.2 * j, .8 * k) + .15 * Vector3::Random();
            block.vertices.insert(block.vertices.end(),
                                  vertex.data(),
                                  vertex.data() + 3);
          }
    return {{block}};
  }

  Eigen::VectorXd
  residual(const MatrixMesh &mesh, const Eigen::VectorXd &x)
  {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(x.size());
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        const auto local = mesh.element(c).residual(mesh.cell_positions(x, c));
        for (unsigned int a = 0; a < mesh.nodes(c).size(); ++a)
          sum.segment<3>(3 * mesh.nodes(c)[a]) += local.segment<3>(3 * a);
      }
    return sum;
  }

  template <class Map>
  Eigen::VectorXd
  moved(const MatrixMesh &mesh, const Map &map)
  {
    Eigen::VectorXd x = mesh.reference();
    for (Eigen::Index i = 0; i < x.size(); i += 3)
      x.segment<3>(i) = map(Vector3(x.segment<3>(i)));
    return x;
  }

  void
  check_patch(Checks &checks, const std::string &name, const MatrixMesh &mesh)
  {
    Matrix3 F;
    F << 1.1, .2, -.1, .05, .9, .1, 0, .15, 1.2;
    const Eigen::VectorXd x =
      moved(mesh, [&](const Vector3 &X) { return Vector3(F * X); });
    const Eigen::VectorXd r     = residual(mesh, x);
    double                inner = 0, error = 0;
    unsigned int          n_inside = 0;
    for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
      {
        unsigned int n_cells = 0;
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
          for (const unsigned int node : mesh.nodes(c))
            n_cells += node == n;
        const bool amid = mesh.degree() == 2 && n == mesh.nodes(0).back();
        if (n_cells == 8 || amid)
          {
            inner = std::max(inner, r.segment<3>(3 * n).norm());
            ++n_inside;
          }
      }
    checks.equal(name + ": nodes inside", n_inside, mesh.degree());
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      for (unsigned int a = 0; a < mesh.nodes(c).size(); ++a)
        error =
          std::max(error, (mesh.deformation_gradient(x, c, a) - F).norm());
    Vector3 sum = Vector3::Zero();
    for (Eigen::Index i = 0; i < r.size(); i += 3)
      sum += r.segment<3>(i);
    checks.below(name + ": forces of an even strain inside", inner, 1e-12);
    checks.below(name + ": sum of its forces", sum.norm(), 1e-12);
    checks.below(name + ": strain of a patch", error, 1e-12);
    double energy = 0, volume = 0;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      energy += mesh.element(c).energy(mesh.cell_positions(x, c));
    volume = std::pow(mesh.cell_size(), 3) * mesh.n_cells();
    checks.below(name + ": energy of a patch",
                 energy / (volume * mesh.law().energy(F)) - 1,
                 1e-12);

    const Eigen::AngleAxisd turn(2.5, Vector3(1, -2, 1).normalized());
    checks.below(name + ": forces of a rigid motion",
                 residual(mesh,
                          moved(mesh,
                                [&](const Vector3 &X) {
                                  return Vector3(turn * X + Vector3(1, 2, 3));
                                }))
                   .lpNorm<Eigen::Infinity>(),
                 1e-12);
  }

  void
  check_element(Checks &checks, const std::string &name, const MatrixMesh &mesh)
  {
    const HexElement &element = mesh.element(0);
    std::srand(3);
    const Eigen::VectorXd rest = mesh.cell_positions(mesh.reference(), 0);
    const Eigen::VectorXd x =
      rest + .05 * Eigen::VectorXd::Random(3 * element.n_nodes());
    const auto energy = [&](const Eigen::VectorXd &y) {
      return element.energy(y);
    };
    const auto force = [&](const Eigen::VectorXd &y) {
      return element.residual(y);
    };
    Eigen::VectorXd r;
    Eigen::MatrixXd tangent;
    element.residual_and_tangent(x, r, tangent);
    checks.below(name + ": residual by differences",
                 relative_error(difference_gradient(energy, x, 1e-6), r),
                 1e-8);
    checks.below(name + ": tangent by differences",
                 relative_error(difference_jacobian(force, x, 1e-6), tangent),
                 1e-8);

    element.residual_and_tangent(rest, r, tangent);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(tangent);
    checks.below(name + ": sixth mode over the largest",
                 modes.eigenvalues()[5] / modes.eigenvalues().tail<1>()[0],
                 1e-12);
    checks.above(name + ": seventh mode over the largest",
                 modes.eigenvalues()[6] / modes.eigenvalues().tail<1>()[0],
                 1e-4);
  }
} // namespace

int
main()
{
  std::ofstream output("output");
  Checks        checks(output);
  for (const std::string name : law_names)
    {
      check_law(checks, name);
      for (const unsigned int degree : {1, 2})
        {
          const std::string text = name + ", degree " + std::to_string(degree);
          const MatrixMesh  mesh(distorted_block(), degree, law(name));
          check_patch(checks, text, mesh);
          check_element(checks, text, mesh);
        }
    }
  const HyperelasticLaw neo_hooke         = law("neo-Hooke");
  const Matrix3         turned_inside_out = Vector3(-1, 1, 1).asDiagonal();
  checks.that("neo-Hooke does not turn inside out",
              std::isinf(neo_hooke.energy(turned_inside_out)));
}
