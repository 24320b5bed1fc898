// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// Energy, residual and tangent of the beam element agree with each other by
// differences, and with an energy written down here from the strain tensor and
// an integration over the disc, whose derivatives Sacado takes.

#include <fiberloom/beams/fiber_mesh.h>

#include <deal.II/base/quadrature_lib.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <Sacado.hpp>

#include <fstream>

#include "checks.h"
#include "sample_fibers.h"

using namespace fiberloom;

namespace
{
  constexpr double radius = 1, E = 1;

  template <typename Number>
  using Dofs = std::array<Number, 27>;
  template <typename Number>
  using Triple = std::array<Number, 3>;
  template <typename Number>
  using Tensor = std::array<Triple<Number>, 3>;

  template <typename Number>
  Number
  dot(const Triple<Number> &a, const Triple<Number> &b)
  {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }

  /** x0 (v = 0), g1 or g2 at a node. */
  template <typename Number>
  Triple<Number>
  node_vector(const Dofs<Number> &q, const unsigned int a, const unsigned int v)
  {
    const double   scale = v == 0 ? 1 : 1 / radius;
    Triple<Number> result;
    for (unsigned int d = 0; d < 3; ++d)
      result[d] = scale * q[9 * a + 3 * v + d];
    return result;
  }

  /** Of a node vector, or by xi with the functions' derivatives. */
  template <typename Number>
  Triple<Number>
  interpolate(const Dofs<Number>          &q,
              const unsigned int           v,
              const std::array<double, 3> &functions)
  {
    Triple<Number> result;
    for (unsigned int d = 0; d < 3; ++d)
      result[d] = 0;
    for (unsigned int a = 0; a < 3; ++a)
      {
        const Triple<Number> node = node_vector(q, a, v);
        for (unsigned int d = 0; d < 3; ++d)
          result[d] += functions[a] * node[d];
      }
    return result;
  }

  /** Of the section strains, in index notation, at a node. */
  template <typename Number>
  Number
  node_strain(const Dofs<Number> &q,
              const Dofs<double> &reference,
              const unsigned int  a,
              const unsigned int  i,
              const unsigned int  j)
  {
    return .5 * (dot(node_vector(q, a, i + 1), node_vector(q, a, j + 1)) -
                 dot(node_vector(reference, a, i + 1),
                     node_vector(reference, a, j + 1)));
  }

  /** Base vectors g1, g2, dx/dxi at the point (z1, z2) of the section at xi. */
  template <typename Number>
  Tensor<Number>
  base_vectors(const Dofs<Number> &q,
               const double        xi,
               const double        z1,
               const double        z2)
  {
    const auto     N = shape_values(xi), dN = shape_derivatives(xi);
    Tensor<Number> g{
      {interpolate(q, 1, N), interpolate(q, 2, N), interpolate(q, 0, dN)}};
    const auto dg1 = interpolate(q, 1, dN), dg2 = interpolate(q, 2, dN);
    for (unsigned int d = 0; d < 3; ++d)
      g[2][d] += z1 * dg1[d] + z2 * dg2[d];
    return g;
  }

  /** Half the square of a strain in one of the two laws. */
  template <typename Number>
  Number
  energy_density(const Tensor<Number> &strain,
                 const double          poisson_ratio,
                 const bool            whole_law)
  {
    const double G = E / (2 * (1 + poisson_ratio));
    const double lambda =
      whole_law ? 2 * G * poisson_ratio / (1 - 2 * poisson_ratio) : 0;
    const double own   = whole_law ? 2 * G : E;
    const Number trace = strain[0][0] + strain[1][1] + strain[2][2];
    Number       w     = .5 * lambda * trace * trace;
    for (unsigned int i = 0; i < 3; ++i)
      {
        w += .5 * own * strain[i][i] * strain[i][i];
        for (unsigned int j = 0; j < i; ++j)
          w += 2 * G * strain[i][j] * strain[i][j];
      }
    return w;
  }

  /**
   * The energy by its definition: the Green-Lagrange strain along an
   * orthonormal frame of the section at points of the disc, its average with
   * the whole law and the rest without Poisson's effect; the energy of the
   * section strains' second difference.
   */
  template <typename Number>
  Number
  energy_by_definition(const Dofs<Number> &q,
                       const Dofs<double> &reference,
                       const double        poisson_ratio,
                       const double        length)
  {
    static const dealii::QGauss<1> radial(6);
    constexpr unsigned int         n_angles = 14;

    Number energy = 0;
    for (const double xi : {-1 / std::sqrt(3.), 1 / std::sqrt(3.)})
      {
        const auto N = shape_values(xi);
        Matrix3    center;
        for (unsigned int i = 0; i < 3; ++i)
          center.col(i) = Vector3(base_vectors(reference, xi, 0, 0)[i].data());
        Matrix3 frame;
        frame.col(0) = center.col(0).normalized();
        frame.col(2) = center.col(0).cross(center.col(1)).normalized();
        frame.col(1) = frame.col(2).cross(frame.col(0));

        std::vector<Tensor<Number>> strains;
        std::vector<double>         volumes;
        Tensor<Number>              average;
        double                      volume = 0;
        for (auto &row : average)
          for (Number &entry : row)
            entry = 0;
        for (unsigned int p = 0; p < radial.size(); ++p)
          for (unsigned int n = 0; n < n_angles; ++n)
            {
              const double rho   = radius * radial.point(p)[0];
              const double angle = 2 * M_PI * n / n_angles;
              const double z1    = rho * std::cos(angle),
                           z2    = rho * std::sin(angle);
              const auto G       = base_vectors(reference, xi, z1, z2);
              const auto g       = base_vectors(q, xi, z1, z2);
              Matrix3    basis;
              for (unsigned int i = 0; i < 3; ++i)
                basis.col(i) = frame.transpose() * Vector3(G[i].data());
              const Matrix3 dual = basis.inverse(); // rows G^i

              Tensor<Number> covariant, strain;
              for (unsigned int i = 0; i < 3; ++i)
                for (unsigned int j = 0; j < 3; ++j)
                  {
                    covariant[i][j] = .5 * (dot(g[i], g[j]) - dot(G[i], G[j]));
                    if (i == 2 || j == 2)
                      continue;
                    covariant[i][j] = 0;
                    for (unsigned int a = 0; a < 3; ++a)
                      covariant[i][j] +=
                        N[a] * node_strain(q, reference, a, i, j);
                  }
              volumes.push_back(basis.determinant() * rho * radius *
                                radial.weight(p) * 2 * M_PI / n_angles);
              volume += volumes.back();
              for (unsigned int a = 0; a < 3; ++a)
                for (unsigned int b = 0; b < 3; ++b)
                  {
                    strain[a][b] = 0;
                    for (unsigned int i = 0; i < 3; ++i)
                      for (unsigned int j = 0; j < 3; ++j)
                        strain[a][b] +=
                          (dual(i, a) * dual(j, b)) * covariant[i][j];
                    average[a][b] += volumes.back() * strain[a][b];
                  }
              strains.push_back(strain);
            }
        for (auto &row : average)
          for (Number &entry : row)
            entry = entry / volume;

        energy += volume * energy_density(average, poisson_ratio, true);
        for (unsigned int p = 0; p < strains.size(); ++p)
          {
            for (unsigned int a = 0; a < 3; ++a)
              for (unsigned int b = 0; b < 3; ++b)
                strains[p][a][b] -= average[a][b];
            energy +=
              volumes[p] * energy_density(strains[p], poisson_ratio, false);
          }
      }

    const double D    = E / (1 - poisson_ratio * poisson_ratio);
    const auto   mode = [&](const unsigned int i, const unsigned int j) {
      return Number((node_strain(q, reference, 0, i, j) -
                     2 * node_strain(q, reference, 1, i, j) +
                     node_strain(q, reference, 2, i, j)) /
                    3.);
    };
    const Number a11 = mode(0, 0), a22 = mode(1, 1), shear = 2 * mode(0, 1);
    return energy + .5 * (M_PI * radius * radius * length / 2) * D *
                      (a11 * a11 + a22 * a22 + 2 * poisson_ratio * a11 * a22 +
                       .5 * (1 - poisson_ratio) * shear * shear);
  }

  Dofs<double>
  to_array(const BeamElement::Vector &q)
  {
    Dofs<double> array;
    std::copy(q.data(), q.data() + 27, array.begin());
    return array;
  }

  void
  check_by_differences(Checks                    &checks,
                       const std::string         &name,
                       const BeamElement         &element,
                       const BeamElement::Vector &q)
  {
    BeamElement::Vector residual, alone;
    BeamElement::Matrix tangent;
    element.residual_and_tangent(q, residual, tangent);
    element.residual(q, alone);
    const auto energy = [&](const BeamElement::Vector &x) {
      return element.energy(x);
    };
    const auto force = [&](const BeamElement::Vector &x) {
      BeamElement::Vector f;
      element.residual(x, f);
      return f;
    };
    checks.below(name + ": residual alone",
                 relative_error(alone, residual),
                 1e-14);
    checks.below(name + ": residual by differences",
                 relative_error(difference_gradient(energy, q, 1e-5), residual),
                 1e-7);
    checks.below(name + ": tangent by differences",
                 relative_error(difference_jacobian(force, q, 1e-5), tangent),
                 1e-7);
    checks.below(name + ": symmetry",
                 relative_error(tangent.transpose(), tangent),
                 1e-14);
  }

  void
  check_by_sacado(Checks                    &checks,
                  const std::string         &name,
                  const BeamElement         &element,
                  const BeamElement::Vector &reference,
                  const BeamElement::Vector &q,
                  const double               poisson_ratio)
  {
    using Fad  = Sacado::Fad::SFad<double, 27>;
    using Fad2 = Sacado::Fad::SFad<Fad, 27>;
    Dofs<Fad2> x;
    for (unsigned int i = 0; i < 27; ++i)
      {
        x[i] = Fad2(27, i, Fad(27, i, q[i]));
      }
    const Fad2 exact = energy_by_definition(x,
                                            to_array(reference),
                                            poisson_ratio,
                                            element.length());

    BeamElement::Vector residual, exact_residual;
    BeamElement::Matrix tangent, exact_tangent;
    element.residual_and_tangent(q, residual, tangent);
    for (unsigned int i = 0; i < 27; ++i)
      {
        exact_residual[i] = exact.dx(i).val();
        for (unsigned int j = 0; j < 27; ++j)
          exact_tangent(i, j) = exact.dx(i).dx(j);
      }
    checks.below(name + ": energy",
                 element.energy(q) / exact.val().val() - 1,
                 1e-10);
    checks.below(name + ": residual by Sacado",
                 relative_error(residual, exact_residual),
                 1e-10);
    checks.below(name + ": tangent by Sacado",
                 relative_error(tangent, exact_tangent),
                 1e-10);
  }

  /** An element's nodes @p reference under a strain along its axis, its
   * sections free [mm]. */
  BeamElement::Vector
  stretched(const BeamElement::Vector &reference,
            const double               strain,
            const double               poisson_ratio)
  {
    BeamElement::Vector q = reference;
    for (unsigned int a = 0; a < 3; ++a)
      {
        q.segment<3>(9 * a) *= 1 + strain;
        q.segment<6>(9 * a + 3) *= 1 - poisson_ratio * strain;
      }
    return q;
  }



  /** Smallest eigenvalue of the tangent [N/mm]. */
  double
  least_stiffness(const BeamElement         &element,
                  const BeamElement::Vector &q,
                  const Curvature            curvature)
  {
    BeamElement::Vector residual;
    BeamElement::Matrix tangent;
    element.residual_and_tangent(q, residual, tangent, curvature);
    return Eigen::SelfAdjointEigenSolver<BeamElement::Matrix>(tangent)
      .eigenvalues()
      .minCoeff();
  }
} // namespace

int
main()
{
  std::ofstream output("output");
  Checks        checks(output);
  std::srand(1);

  const auto line = [](const double t) { return Vector3(5 * t, 4 * t, 3 * t); };
  const auto arc  = [](const double t) {
    return Vector3(20 * std::sin(.5 * t),
                   20 - 20 * std::cos(.5 * t),
                   3 * t * t);
  };
  for (const double poisson_ratio : {.3, .45})
    for (const bool curved : {false, true})
      {
        const FiberMesh           mesh(loose_fibers(
          {curved ? curved_fiber(arc, 1, Vector3(.2, .4, 1), poisson_ratio) :
                              curved_fiber(line, 1, Vector3(.2, .4, 1), poisson_ratio)}));
        const BeamElement        &element = mesh.element(0);
        const BeamElement::Vector q =
          mesh.reference() + .4 * BeamElement::Vector::Random();
        const std::string name = std::string(curved ? "curved" : "straight") +
                                 (poisson_ratio == .3 ? ", .3" : ", .45");
        check_by_differences(checks, name, element, q);
        if (poisson_ratio == .3)
          check_by_differences(checks,
                               name + ", linear",
                               BeamElement(mesh.reference(),
                                           1,
                                           E,
                                           poisson_ratio,
                                           AxialLaw::linear),
                               q);
        check_by_sacado(
          checks, name, element, mesh.reference(), q, poisson_ratio);
      }

  // Of a straight element compression alone makes the energy concave, of a bent
  // and twisted one other stresses as well; absolute values never do.
  const double    poisson_ratio = .3, strain = .01;
  const FiberMesh straight(
    loose_fibers({curved_fiber(line, 1, Vector3(.2, .4, 1), poisson_ratio)}));
  const auto least = [&](const double sign, const Curvature curvature) {
    return least_stiffness(straight.element(0),
                           stretched(straight.reference(),
                                     sign * strain,
                                     poisson_ratio),
                           curvature);
  };
  const double compressed = least(-1, Curvature::exact);
  checks.below("compressed: least stiffness beyond -1e-3",
               std::max(0., compressed + 1e-3),
               1e-12);
  checks.below("compressed, without what makes it negative",
               least(-1, Curvature::convex) / compressed,
               1e-9);
  checks.below("stretched: without less with",
               std::abs(least(1, Curvature::convex) -
                        least(1, Curvature::exact)) /
                 -compressed,
               1e-12);
  unsigned int n_concave = 0;
  for (unsigned int k = 0; k < 10; ++k)
    {
      const BeamElement::Vector q =
        straight.reference() + .4 * BeamElement::Vector::Random();
      n_concave += least_stiffness(straight.element(0), q, Curvature::exact) <
                   .01 * compressed;
      checks.below("random, without what makes it negative",
                   least_stiffness(straight.element(0), q, Curvature::convex) /
                     compressed,
                   1e-6);
    }
  checks.below("random: half of them are concave", n_concave < 5, .5);
}
