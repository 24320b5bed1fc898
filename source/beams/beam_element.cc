// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>

#include <fiberloom/beams/beam_element.h>
#include <fiberloom/beams/shape_functions.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace fiberloom
{
  namespace
  {
    constexpr std::array<double, 2> gauss_xi{
      {-0.57735026918962576, 0.57735026918962576}};

    // Second difference of a nodal value: the mode 3 xi^2 - 1.
    constexpr std::array<double, 3> mode{{1. / 3, -2. / 3, 1. / 3}};

    // Rows of the generalised strains that live in the section alone, and the
    // section vectors they are made of.
    constexpr std::array<unsigned int, 3> section_rows{{0, 1, 5}};
    constexpr unsigned int section_vectors[3][2] = {{1, 1}, {2, 2}, {1, 2}};

    // The strain of the centre line among the generalised strains.
    constexpr unsigned int axial = 2;

    /**
     * What makes the axial force linear in the stretch: energy over E A and
     * its derivatives by the centre line's strain @p e .
     */
    struct LinearAxialLaw
    {
      LinearAxialLaw(const double e)
        : stretch(std::sqrt(std::max(1 + 2 * e, 1e-12)))
        , energy(.5 * ((stretch - 1) * (stretch - 1) - e * e))
        , force((stretch - 1) / stretch - e)
        , stiffness(1 / (stretch * stretch * stretch) - 1)
      {}

      const double stretch, energy, force, stiffness;
    };

    // Of a broken element's stiffness along the axis: enough for a factor in
    // single precision, and with a gap as long as the element a force of some
    // 1e-4 of what breaks a fiber at 2 %.
    constexpr double rest = 1e-6;

    // Which nodal vector (x0, r g1, r g2) each of q1..q5 interpolates.
    constexpr std::array<unsigned int, 5> slot{{1, 2, 0, 1, 2}};

    /** Coefficients of the nodal vectors in q1..q5. */
    struct Interpolation
    {
      std::array<std::array<double, 3>, 5> coefficients;

      Interpolation(const std::array<double, 3> &shape,
                    const std::array<double, 3> &derivative,
                    const double                 radius)
      {
        for (unsigned int a = 0; a < 3; ++a)
          {
            coefficients[0][a] = coefficients[1][a] = shape[a] / radius;
            coefficients[2][a]                      = derivative[a];
            coefficients[3][a] = coefficients[4][a] = derivative[a] / radius;
          }
      }

      std::array<Vector3, 5>
      operator()(const BeamElement::Vector &q) const
      {
        std::array<Vector3, 5> vectors;
        for (unsigned int i = 0; i < 5; ++i)
          {
            vectors[i].setZero();
            for (unsigned int a = 0; a < 3; ++a)
              vectors[i] +=
                coefficients[i][a] * q.segment<3>(9 * a + 3 * slot[i]);
          }
        return vectors;
      }
    };

    SectionStiffness::Vector
    gram(const std::array<Vector3, 5> &q)
    {
      SectionStiffness::Vector e;
      for (unsigned int k = 0; k < SectionStiffness::n_strains; ++k)
        {
          const auto [i, j] = SectionStiffness::pairs[k];
          e[k]              = (i == j ? .5 : 1.) * q[i].dot(q[j]);
        }
      return e;
    }

    /** e11, e22, e12 (rows) at the three nodes (columns), reference included.
     */
    Matrix3
    node_section_gram(const BeamElement::Vector &q, const double radius)
    {
      Matrix3 e;
      for (unsigned int a = 0; a < 3; ++a)
        {
          const Vector3 g1 = q.segment<3>(9 * a + 3) / radius;
          const Vector3 g2 = q.segment<3>(9 * a + 6) / radius;
          e.col(a) << .5 * g1.squaredNorm(), .5 * g2.squaredNorm(), g1.dot(g2);
        }
      return e;
    }

    /** Part of a tangent that depends on stress; it acts alike on the three
     * directions. */
    using Geometric = Eigen::Matrix<double, 9, 9>;

    /** Calls @p visit (k, i, j) for each strain k by q_i and q_j that is not of
     * the section alone. */
    template <typename Visit>
    void
    for_line_strains(const Visit &visit)
    {
      for (unsigned int k = 0; k < SectionStiffness::n_strains; ++k)
        {
          const auto [i, j] = SectionStiffness::pairs[k];
          if (i >= 2 || j >= 2)
            visit(k, i, j);
        }
    }

    /** Of the stress resultants @p S . */
    void
    add_forces(const Interpolation            &interpolation,
               const std::array<Vector3, 5>   &vectors,
               const SectionStiffness::Vector &S,
               BeamElement::Vector            &residual)
    {
      for_line_strains(
        [&](const unsigned int k, const unsigned int i, const unsigned int j) {
          for (unsigned int a = 0; a < 3; ++a)
            {
              residual.segment<3>(9 * a + 3 * slot[i]) +=
                S[k] * interpolation.coefficients[i][a] * vectors[j];
              if (i != j)
                residual.segment<3>(9 * a + 3 * slot[j]) +=
                  S[k] * interpolation.coefficients[j][a] * vectors[i];
            }
        });
    }

    void
    add_geometric(const Interpolation            &interpolation,
                  const SectionStiffness::Vector &S,
                  Geometric                      &geometric)
    {
      for_line_strains(
        [&](const unsigned int k, const unsigned int i, const unsigned int j) {
          for (unsigned int a = 0; a < 3; ++a)
            for (unsigned int b = 0; b < 3; ++b)
              {
                const double value = S[k] * interpolation.coefficients[i][a] *
                                     interpolation.coefficients[j][b];
                geometric(3 * a + slot[i], 3 * b + slot[j]) += value;
                if (i != j)
                  geometric(3 * b + slot[j], 3 * a + slot[i]) += value;
              }
        });
    }

    Geometric
    with_absolute_modes(const Geometric &geometric)
    {
      const Eigen::SelfAdjointEigenSolver<Geometric> modes(geometric);
      return modes.eigenvectors() *
             modes.eigenvalues().cwiseAbs().asDiagonal() *
             modes.eigenvectors().transpose();
    }
  } // namespace



  BeamElement::BeamElement(const Vector  &reference,
                           const double   radius,
                           const double   young_modulus,
                           const double   poisson_ratio,
                           const AxialLaw law)
    : radius(radius)
    , linear_stiffness(
        law == AxialLaw::linear ? M_PI * radius * radius * young_modulus : 0)
    , reference_length(0)
    , node_gram(node_section_gram(reference, radius))
  {
    for (const double xi : gauss_xi)
      {
        const auto dN         = shape_derivatives(xi);
        Vector3    derivative = Vector3::Zero();
        for (unsigned int a = 0; a < 3; ++a)
          derivative += dN[a] * reference.segment<3>(9 * a);
        reference_length += derivative.norm();
      }
    if (!(reference_length > 0))
      throw InputError("a fiber element has no length");

    const double jacobian = reference_length / 2;
    for (unsigned int p = 0; p < 2; ++p)
      {
        GaussPoint &point = points[p];
        point.weight      = jacobian;
        point.shape       = shape_values(gauss_xi[p]);
        point.derivative  = shape_derivatives(gauss_xi[p]);
        for (double &value : point.derivative)
          value /= jacobian;

        const auto q =
          Interpolation(point.shape, point.derivative, radius)(reference);
        point.reference_gram = gram(q);

        const bool straight =
          q[3].norm() * radius < 1e-10 && q[4].norm() * radius < 1e-10 &&
          std::abs(q[2].norm() - 1) < 1e-10 &&
          std::abs(q[2].dot(q[0])) + std::abs(q[2].dot(q[1])) +
              std::abs(q[0].dot(q[1])) <
            1e-10;
        point.stiffness =
          straight ?
            SectionStiffness::straight(radius, young_modulus, poisson_ratio) :
            SectionStiffness::curved(q, radius, young_modulus, poisson_ratio);
        for (const unsigned int row : section_rows)
          point.reference_gram[row] = 0; // subtracted at the nodes
      }

    const double factor = M_PI * radius * radius * jacobian * young_modulus /
                          (1 - poisson_ratio * poisson_ratio);
    hourglass_stiffness << factor, poisson_ratio * factor, 0,
      poisson_ratio * factor, factor, 0, 0, 0, (1 - poisson_ratio) / 2 * factor;
  }



  void
  BeamElement::strains(const std::array<Vector3, 5> &vectors,
                       const Matrix3                &section_strain,
                       const GaussPoint             &point,
                       SectionStiffness::Vector     &strain) const
  {
    strain = gram(vectors) - point.reference_gram;
    for (unsigned int k = 0; k < 3; ++k)
      {
        strain[section_rows[k]] = 0;
        for (unsigned int a = 0; a < 3; ++a)
          strain[section_rows[k]] += point.shape[a] * section_strain(k, a);
      }
  }



  SectionStiffness::Vector
  BeamElement::stress(const GaussPoint               &point,
                      const SectionStiffness::Vector &strain) const
  {
    SectionStiffness::Vector S = point.stiffness * strain;
    if (linear_stiffness > 0)
      S[axial] += linear_stiffness * LinearAxialLaw(strain[axial]).force;
    return S;
  }



  double
  BeamElement::energy(const Vector &q) const
  {
    const Matrix3 section_strain = node_section_gram(q, radius) - node_gram;
    double        energy         = 0;
    for (const GaussPoint &point : points)
      {
        SectionStiffness::Vector e;
        strains(Interpolation(point.shape, point.derivative, radius)(q),
                section_strain,
                point,
                e);
        energy += .5 * point.weight * e.dot(point.stiffness * e);
        if (linear_stiffness > 0)
          energy +=
            point.weight * linear_stiffness * LinearAxialLaw(e[axial]).energy;
      }
    const Vector3 a = section_strain * Eigen::Map<const Vector3>(mode.data());
    return energy + .5 * a.dot(hourglass_stiffness * a);
  }



  bool
  BeamElement::is_folded(const Vector &q) const
  {
    // Stretches of the line and of sections below which shortening further
    // takes less force, by a law that is quadratic in Green-Lagrange strains.
    constexpr double least_squared = 1. / 3;
    return std::any_of(points.begin(), points.end(), [&](const auto &point) {
      const auto vectors =
        Interpolation(point.shape, point.derivative, radius)(q);
      return vectors[0].cross(vectors[1]).dot(vectors[2]) <= 0 ||
             std::any_of(vectors.begin(),
                         vectors.begin() + 3,
                         [](const Vector3 &v) {
                           return v.squaredNorm() < least_squared;
                         });
    });
  }



  double
  BeamElement::largest_strain(const Vector &q) const
  {
    constexpr std::array<unsigned int, 2> bending{{12, 13}}; // e34, e35
    const Matrix3 section_strain = node_section_gram(q, radius) - node_gram;
    double        largest        = -1;
    for (const GaussPoint &point : points)
      {
        SectionStiffness::Vector e;
        strains(Interpolation(point.shape, point.derivative, radius)(q),
                section_strain,
                point,
                e);
        const double outermost =
          e[axial] + radius * std::hypot(e[bending[0]], e[bending[1]]);
        largest =
          std::max(largest, std::sqrt(std::max(1 + 2 * outermost, 0.)) - 1);
      }
    return largest;
  }



  BeamElement
  BeamElement::broken() const
  {
    BeamElement element = *this;
    element.linear_stiffness *= rest;
    for (GaussPoint &point : element.points)
      {
        const SectionStiffness::Vector row = point.stiffness.col(axial);
        point.stiffness -= (1 - rest) / row[axial] * row * row.transpose();
      }
    return element;
  }



  void
  BeamElement::residual(const Vector &q, Vector &residual) const
  {
    evaluate<Curvature::none>(q, residual, nullptr);
  }



  void
  BeamElement::residual_and_tangent(const Vector &q,
                                    Vector       &residual,
                                    Matrix       &tangent,
                                    Curvature     curvature) const
  {
    if (curvature == Curvature::convex)
      evaluate<Curvature::convex>(q, residual, &tangent);
    else
      evaluate<Curvature::exact>(q, residual, &tangent);
  }



  template <Curvature curvature>
  void
  BeamElement::evaluate(const Vector &q,
                        Vector       &residual,
                        Matrix       *tangent) const
  {
    constexpr bool with_tangent   = curvature != Curvature::none;
    const Matrix3  section_strain = node_section_gram(q, radius) - node_gram;

    // Stress resultants that multiply the section strains of each node.
    const Vector3 mode_stress =
      hourglass_stiffness *
      (section_strain * Eigen::Map<const Vector3>(mode.data()));
    Matrix3 node_stress =
      mode_stress * Eigen::Map<const Eigen::RowVector3d>(mode.data());

    residual.setZero();
    Geometric geometric = Geometric::Zero();
    if constexpr (with_tangent)
      tangent->setZero();

    for (const GaussPoint &point : points)
      {
        const Interpolation      interpolation(point.shape,
                                          point.derivative,
                                          radius);
        const auto               vectors = interpolation(q);
        SectionStiffness::Vector e;
        strains(vectors, section_strain, point, e);
        const SectionStiffness::Vector S = point.weight * stress(point, e);

        for (unsigned int k = 0; k < 3; ++k)
          for (unsigned int a = 0; a < 3; ++a)
            node_stress(k, a) += point.shape[a] * S[section_rows[k]];
        add_forces(interpolation, vectors, S, residual);

        if constexpr (with_tangent)
          {
            add_geometric(interpolation, S, geometric);
            const StrainGradient B =
              strain_gradient(interpolation, vectors, point, q);
            StrainGradient DB = point.stiffness * B;
            if (linear_stiffness > 0)
              DB.row(axial) += linear_stiffness *
                               LinearAxialLaw(e[axial]).stiffness *
                               B.row(axial);
            tangent->noalias() += point.weight * (B.transpose() * DB);
          }
      }

    for (unsigned int a = 0; a < 3; ++a)
      for (unsigned int k = 0; k < 3; ++k)
        {
          residual.segment<9>(9 * a) +=
            node_stress(k, a) * node_section_gradient(q, k, a).transpose();
          const double value = node_stress(k, a) / (radius * radius);
          const auto [i, j]  = section_vectors[k];
          geometric(3 * a + i, 3 * a + j) += value;
          if (i != j)
            geometric(3 * a + j, 3 * a + i) += value;
        }

    if constexpr (with_tangent)
      {
        Eigen::Matrix<double, 3, 27> gradient;
        for (unsigned int k = 0; k < 3; ++k)
          for (unsigned int a = 0; a < 3; ++a)
            gradient.block<1, 9>(k, 9 * a) =
              mode[a] * node_section_gradient(q, k, a);
        tangent->noalias() +=
          gradient.transpose() * (hourglass_stiffness * gradient);
        if constexpr (curvature == Curvature::convex)
          geometric = with_absolute_modes(geometric);
        for (unsigned int a = 0; a < 9; ++a)
          for (unsigned int b = 0; b < 9; ++b)
            for (unsigned int d = 0; d < 3; ++d)
              (*tangent)(3 * a + d, 3 * b + d) += geometric(a, b);
      }
  }



  template <typename Interpolation>
  BeamElement::StrainGradient
  BeamElement::strain_gradient(const Interpolation          &interpolation,
                               const std::array<Vector3, 5> &vectors,
                               const GaussPoint             &point,
                               const Vector                 &q) const
  {
    StrainGradient B = StrainGradient::Zero();
    for_line_strains(
      [&](const unsigned int k, const unsigned int i, const unsigned int j) {
        for (unsigned int a = 0; a < 3; ++a)
          {
            B.block<1, 3>(k, 9 * a + 3 * slot[i]) +=
              interpolation.coefficients[i][a] * vectors[j].transpose();
            if (i != j)
              B.block<1, 3>(k, 9 * a + 3 * slot[j]) +=
                interpolation.coefficients[j][a] * vectors[i].transpose();
          }
      });
    for (unsigned int k = 0; k < 3; ++k)
      for (unsigned int a = 0; a < 3; ++a)
        B.block<1, 9>(section_rows[k], 9 * a) =
          point.shape[a] * node_section_gradient(q, k, a);
    return B;
  }



  Eigen::Matrix<double, 1, 9>
  BeamElement::node_section_gradient(const Vector      &q,
                                     const unsigned int strain,
                                     const unsigned int node) const
  {
    Eigen::Matrix<double, 1, 9> gradient = Eigen::Matrix<double, 1, 9>::Zero();
    const auto [i, j]                    = section_vectors[strain];
    const double scale                   = 1 / (radius * radius);
    gradient.segment<3>(3 * i) = scale * q.segment<3>(9 * node + 3 * j);
    if (i != j)
      gradient.segment<3>(3 * j) = scale * q.segment<3>(9 * node + 3 * i);
    return gradient;
  }



  BeamElement::SectionForces
  BeamElement::section_forces(const Vector      &q,
                              const unsigned int gauss_point) const
  {
    const GaussPoint &point = points[gauss_point];
    const auto        vectors =
      Interpolation(point.shape, point.derivative, radius)(q);
    SectionStiffness::Vector e;
    strains(vectors, node_section_gram(q, radius) - node_gram, point, e);
    const SectionStiffness::Vector S = stress(point, e);

    std::array<Vector3, 5> conjugate;
    conjugate.fill(Vector3::Zero());
    for (unsigned int k = 0; k < SectionStiffness::n_strains; ++k)
      {
        const auto [i, j] = SectionStiffness::pairs[k];
        conjugate[i] += S[k] * vectors[j];
        if (i != j)
          conjugate[j] += S[k] * vectors[i];
      }
    return {conjugate[2],
            vectors[0].cross(conjugate[3]) + vectors[1].cross(conjugate[4])};
  }
} // namespace fiberloom
