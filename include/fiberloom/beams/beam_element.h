// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_beams_beam_element_h
#define fiberloom_beams_beam_element_h

#include <fiberloom/base/curvature.h>
#include <fiberloom/base/vector_types.h>

#include <fiberloom/fabric/fiber_set.h>

#include <fiberloom/beams/section_stiffness.h>

#include <array>

namespace fiberloom
{
  /**
   * A three-node beam element whose sections deform affinely, equations [1] to
   * [3] of the paper: x(z) = x0 + z1 g1 + z2 g2. Nine dofs a node, scaled to
   * lengths: x0, r g1, r g2 [mm]; node order: start, middle, end.
   *
   * Energy: the full Green-Lagrange strain relative to the reference
   * placement with the Saint Venant-Kirchhoff law, in the form that is free of
   * Poisson locking (SectionStiffness), two Gauss points along the axis. The
   * strains E11, E22 and 2 E12 of the section are sampled at the nodes and
   * interpolated to the Gauss points, and their second difference a carries
   * the energy (A L/4) a.D_ps a with the plane-stress matrix D_ps: without it
   * the section can oscillate along the fiber as 3 xi^2 - 1 at no cost.
   *
   * With AxialLaw::linear the energy of the centre line's strain e33,
   * E A e33^2/2, makes way for E A (lambda - 1)^2/2, lambda^2 = 1 + 2 e33: the
   * axial force is then N = E A (lambda - 1).
   */
  class BeamElement
  {
  public:
    using Vector = Eigen::Matrix<double, 27, 1>;
    using Matrix = Eigen::Matrix<double, 27, 27>;

    /**
     * @p reference : stress-free dofs, x0, r g1, r g2 of each node [mm].
     * @p radius : [mm], @p young_modulus : [MPa]. Throws InputError where the
     * reference is degenerate.
     */
    BeamElement(const Vector  &reference,
                const double   radius,
                const double   young_modulus,
                const double   poisson_ratio,
                const AxialLaw law = AxialLaw::saint_venant_kirchhoff);

    /** Elastic energy at the 27 dofs @p q [N mm]. */
    double
    energy(const Vector &q) const;

    /** Gradient of the energy by the 27 dofs @p q [N]. */
    void
    residual(const Vector &q, Vector &residual) const;

    /**
     * Gradient [N] and 27 x 27 Hessian [N/mm] of the energy at @p q . With a
     * @p curvature other than exact the tangent is what that leaves of the
     * Hessian.
     */
    void
    residual_and_tangent(const Vector &q,
                         Vector       &residual,
                         Matrix       &tangent,
                         Curvature     curvature = Curvature::exact) const;

    /** Force and moment that the part beyond exerts on the part before. */
    struct SectionForces
    {
      Vector3 force;  // [N]
      Vector3 moment; // [N mm], about the section's centre
    };

    /** Section forces at @p q in Gauss point 0 or 1. */
    SectionForces
    section_forces(const Vector &q, const unsigned int gauss_point) const;

    /**
     * Whether the centre line runs against its sections somewhere, or a stretch
     * of it or of a section is below 1/sqrt(3). The law has no stress at a
     * stretch of -1, so that equations alone can lead there.
     */
    bool
    is_folded(const Vector &q) const;

    /**
     * Strain of the most strained line along the fiber in its sections, to
     * first order in the curvature: sqrt(1 + 2 e) - 1 with e = e33 + r
     * sqrt(e34^2 + e35^2), the strain of the centre line and, on the outermost
     * line, of bending. The larger one of the two Gauss points. Section 1.8 of
     * the theory.
     */
    double
    largest_strain(const Vector &q) const;

    /**
     * This element broken through: the strain of its centre line is whatever
     * makes the stress along it vanish, so that its ends slide apart as in a
     * sleeve. Across the fiber they still hold each other, or what touches the
     * element would push it away. A millionth of the stiffness is left, since
     * a piece of a fiber that nothing else holds along its axis would make the
     * equations singular.
     */
    BeamElement
    broken() const;

    /** Reference length of the centre line [mm]. */
    double
    length() const
    {
      return reference_length;
    }

  private:
    using StrainGradient = Eigen::Matrix<double, 15, 27>;

    struct GaussPoint
    {
      SectionStiffness::Matrix stiffness; // per unit length
      SectionStiffness::Vector reference_gram;
      double                   weight; // times jacobian
      std::array<double, 3>    shape, derivative;
    };

    /**
     * Section strains interpolated from the nodes, the others from @p vectors .
     */
    void
    strains(const std::array<Vector3, 5> &vectors,
            const Matrix3                &section_strain,
            const GaussPoint             &point,
            SectionStiffness::Vector     &strain) const;

    /** Stress resultants [N]. */
    SectionStiffness::Vector
    stress(const GaussPoint               &point,
           const SectionStiffness::Vector &strain) const;

    template <Curvature curvature>
    void
    evaluate(const Vector &q, Vector &residual, Matrix *tangent) const;

    /** Derivative of the strains at @p point by @p q . */
    template <typename Interpolation>
    StrainGradient
    strain_gradient(const Interpolation          &interpolation,
                    const std::array<Vector3, 5> &vectors,
                    const GaussPoint             &point,
                    const Vector                 &q) const;

    /**
     * Derivative of the section strain e11, e22 or e12 at a node by that node's
     * nine dofs.
     */
    Eigen::Matrix<double, 1, 9>
    node_section_gradient(const Vector      &q,
                          const unsigned int strain,
                          const unsigned int node) const;

    double                    radius;
    double                    linear_stiffness; // E A [N] of that law, else 0
    double                    reference_length;
    std::array<GaussPoint, 2> points;
    Matrix3 node_gram; // e11, e22, e12 (rows) at the nodes (columns)
    Matrix3 hourglass_stiffness;
  };
} // namespace fiberloom

#endif
