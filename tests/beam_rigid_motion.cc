// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// Rigid motions cost nothing, forces turn with a deformed element (case A7 of
// the reference cases), nothing but the six rigid motions is free, and what is
// pressed too far is known.

#include <fstream>

#include "checks.h"
#include "dense_beams.h"
#include "sample_fibers.h"

using namespace fiberloom;

namespace
{
  Eigen::VectorXd
  turned(const Eigen::VectorXd &q, const Matrix3 &R)
  {
    Eigen::VectorXd result(q.size());
    for (Eigen::Index i = 0; i < q.size(); i += 3)
      result.segment<3>(i) = R * q.segment<3>(i);
    return result;
  }

  Eigen::VectorXd
  moved(const Eigen::VectorXd &q, const Matrix3 &R, const Vector3 &shift)
  {
    Eigen::VectorXd result = turned(q, R);
    for (Eigen::Index i = 0; i < q.size(); i += 9)
      result.segment<3>(i) += shift;
    return result;
  }

  void
  check_motions(Checks                &checks,
                const std::string     &name,
                const BeamElement     &element,
                const Eigen::VectorXd &reference)
  {
    const Eigen::VectorXd bent =
      reference + .3 * Eigen::VectorXd::Random(reference.size());
    BeamElement::Vector residual, expected;
    element.residual(bent, expected);
    const double energy = element.energy(bent);
    const auto   forces = element.section_forces(bent, 0);

    double rest_energy = 0, rest_force = 0, change_of_energy = 0,
           change_of_force = 0, change_of_section = 0;
    for (const double angle : {10., 60., 90., 170., 250., 350.})
      {
        const Matrix3 R =
          Eigen::AngleAxisd(angle * M_PI / 180, Vector3(1, -2, .5).normalized())
            .toRotationMatrix();
        const Vector3 shift(3, -7, 5);

        const Eigen::VectorXd rigid = moved(reference, R, shift);
        element.residual(rigid, residual);
        rest_energy = std::max(rest_energy, element.energy(rigid) / energy);
        rest_force  = std::max(rest_force,
                              residual.lpNorm<Eigen::Infinity>() /
                                expected.lpNorm<Eigen::Infinity>());

        const Eigen::VectorXd both = moved(bent, R, shift);
        element.residual(both, residual);
        change_of_energy =
          std::max(change_of_energy,
                   std::abs(element.energy(both) / energy - 1));
        change_of_force =
          std::max(change_of_force,
                   relative_error(residual, turned(expected, R)));
        const auto turned_forces = element.section_forces(both, 0);
        change_of_section =
          std::max({change_of_section,
                    relative_error(turned_forces.force, R * forces.force),
                    relative_error(turned_forces.moment, R * forces.moment)});
      }
    checks.below(name + ": energy of a rigid motion", rest_energy, 1e-10);
    checks.below(name + ": force of a rigid motion", rest_force, 1e-10);
    checks.below(name + ": energy of the bent one", change_of_energy, 1e-10);
    checks.below(name + ": forces turn with it", change_of_force, 1e-10);
    checks.below(name + ": section forces, too", change_of_section, 1e-10);
  }

  // The law gives way from a stretch of 0.577 on, and has no stress at -1.
  void
  check_folding(Checks                &checks,
                const BeamElement     &element,
                const Eigen::VectorXd &reference)
  {
    const auto folds = [&](const unsigned int vector, const double stretch) {
      Eigen::VectorXd q = reference;
      for (Eigen::Index i = 3 * vector; i < q.size(); i += 9)
        q.segment<3>(i) *= stretch;
      return element.is_folded(q);
    };
    for (const unsigned int vector : {0, 1, 2})
      {
        const std::string name = "folded, vector " + std::to_string(vector);
        checks.equal(name + " of 0.58", folds(vector, .58), false);
        checks.equal(name + " of 0.57", folds(vector, .57), true);
        checks.equal(name + " of -1", folds(vector, -1), true);
      }
  }

  void
  check_section_change(Checks &checks, const FiberMesh &mesh)
  {
    const auto change = [&](const Eigen::Matrix2d &stretch) {
      DofVector     q  = mesh.reference();
      const Vector3 g1 = q.segment<3>(12), g2 = q.segment<3>(15);
      q.segment<3>(12) = stretch(0, 0) * g1 + stretch(1, 0) * g2;
      q.segment<3>(15) = stretch(0, 1) * g1 + stretch(1, 1) * g2;
      return mesh.largest_section_change(q);
    };
    const double c = std::cos(.3), s = std::sin(.3);
    checks.equal("change of a section that turns",
                 change((Eigen::Matrix2d() << c, -s, s, c).finished()),
                 0);
    checks.equal("of one that widens by 0.1 and narrows by 0.2",
                 change(Eigen::Vector2d(1.1, .8).asDiagonal()),
                 .2);
    checks.equal("of one that is sheared by 0.2",
                 change((Eigen::Matrix2d() << 1, .2, 0, 1).finished()),
                 std::sqrt(1.01) - .9);
  }

  void
  count_zero_modes(std::ostream      &output,
                   Checks            &checks,
                   const std::string &name,
                   const FiberMesh   &mesh)
  {
    Eigen::VectorXd residual;
    Eigen::MatrixXd tangent;
    assemble_dense(mesh, mesh.reference(), residual, tangent);
    const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(tangent).eigenvalues();
    const double largest = values.tail<1>()[0];
    std::cout << name << ": " << values.head<8>().transpose() / largest
              << std::endl;
    output << name << ": zero modes "
           << (values.array().abs() < 1e-13 * largest).count() << std::endl;
    checks.above(name + ": first other mode over the largest",
                 values[6] / largest,
                 1e-7);
  }
} // namespace

int
main()
{
  std::ofstream output("output");
  Checks        checks(output);
  std::srand(1);

  const auto arc = [](const double t) {
    return Vector3(12 * std::sin(t), 12 - 12 * std::cos(t), 2 * t * t);
  };
  const Vector3 up(0, 0, 1), end(6, 5, 8);
  for (const unsigned int n : {1, 4})
    {
      const FiberMesh straight(
        loose_fibers({straight_fiber(Vector3::Zero(), n * end, n)}));
      const FiberMesh   curved(loose_fibers({curved_fiber(arc, n, up)}));
      const std::string size = ", elements " + std::to_string(n);
      if (n == 1)
        {
          check_motions(checks,
                        "straight",
                        straight.element(0),
                        straight.reference());
          check_folding(checks, straight.element(0), straight.reference());
          check_section_change(checks, straight);
          check_motions(checks,
                        "curved",
                        curved.element(0),
                        curved.reference());
        }
      count_zero_modes(output, checks, "straight" + size, straight);
      count_zero_modes(output, checks, "curved" + size, curved);
    }
}
