// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_coupling_junction_h
#define fiberloom_coupling_junction_h

#include <fiberloom/beams/fiber_mesh.h>

#include <fiberloom/matrix/matrix_mesh.h>

#include <array>
#include <vector>

namespace fiberloom
{
  /**
   * Section 5 of the paper: an elastic spring between a particle of a fiber and
   * the particle of the matrix that is at the same place when the matrix is
   * added. Its length is then zero, so that the spring is free of stress, and
   * its energy k/2 |x_f - x_m|^2 knows no direction: no rotation of both loads
   * it.
   */
  struct Junction
  {
    ElementPoint          point;           // of the fiber
    std::array<double, 2> particle;        // components along r g1 and r g2
    CellPoint             place;           // in the matrix
    double                stiffness;       // k [N/mm]
    std::array<int, 2>    periods{{0, 0}}; // from the place on, of a cell

    template <class Archive>
    void
    serialize(Archive &ar, const unsigned int)
    {
      ar &point.element &point.xi &particle &place.cell;
      for (unsigned int i = 0; i < 3; ++i)
        ar &place.coordinates[i];
      ar &stiffness &periods;
    }
  };

  /**
   * A junction with what it needs of the meshes. Both particles follow their
   * nodes linearly: x_f = sum N_a (x0_a + z1/r r g1_a + z2/r r g2_a), x_m = sum
   * M_b x_b. Section 6.3 of the theory.
   */
  class JunctionElement
  {
  public:
    /**
     * Takes nodes and weights of @p junction from the meshes of fibers and
     * matrix, which are not kept.
     */
    JunctionElement(const Junction   &junction,
                    const FiberMesh  &fibers,
                    const MatrixMesh &matrix);

    /** Three nodes of the fiber, then those of the matrix in its own numbers:
     * of the cell, and where periods lie between, those that these are counted
     * by. */
    const std::array<unsigned int, 3> &
    fiber_nodes() const
    {
      return nodes_of_fiber;
    }

    /** Nodes of the matrix in its own numbers, see fiber_nodes(). */
    const std::vector<unsigned int> &
    matrix_nodes() const
    {
      return nodes_of_matrix;
    }

    /** Position of the fiber's particle [mm]; @p q as in FiberMesh. */
    Vector3
    fiber_particle(const DofVector &q) const;

    /** Position of the matrix's particle [mm]; @p x as in MatrixMesh. */
    Vector3
    matrix_particle(const Eigen::VectorXd &x) const;

    /** Force on the fiber's particle [N]. */
    Vector3
    force(const DofVector &q, const Eigen::VectorXd &x) const
    {
      return stiffness * (matrix_particle(x) - fiber_particle(q));
    }

    /** Energy of the spring, k/2 |x_f - x_m|^2 [N mm]. */
    double
    energy(const DofVector &q, const Eigen::VectorXd &x) const
    {
      return .5 / stiffness * force(q, x).squaredNorm();
    }

    /**
     * Derivative of x_f - x_m by each vector of the dofs, a multiple of the
     * unit matrix: three vectors for each node of the fiber, one for each of
     * the matrix.
     */
    const std::vector<double> &
    weights() const
    {
      return vector_weights;
    }

    /** Stiffness k of the spring [N/mm]. */
    double
    spring() const
    {
      return stiffness;
    }

  private:
    double                      stiffness; // [N/mm]
    std::array<unsigned int, 3> nodes_of_fiber;
    std::vector<unsigned int>   nodes_of_matrix;
    std::vector<double>         vector_weights;
  };

  /**
   * Stiffness of the matrix around a fiber per length of it [MPa]: Cox's shear
   * lag, 2 pi G / ln(R/r), with the matrix at rest at the distance R from the
   * axis (H. L. Cox, British Journal of Applied Physics 3, 1952, 72).
   */
  double
  shear_lag_stiffness(const double young_modulus,
                      const double poisson_ratio,
                      const double distance_over_radius);

  /** Junctions as find_junctions() finds them, and particles without one. */
  struct FoundJunctions
  {
    std::vector<Junction> junctions;

    /** Particles that should have one but lie outside every cell. */
    unsigned int n_outside = 0;
    Vector3      an_outside_place; // of one of them [mm]
  };

  /**
   * Junctions of the fibers placed at @p q with a matrix at rest, at even
   * distances along each fiber. Filled, all centres of fibers have one. Layers
   * meet the outermost particle of a section's skin; it should be in a layer if
   * it is no deeper below the skins around it than the overlap.
   */
  FoundJunctions
  find_junctions(const MatrixParameters &parameters,
                 const FiberMesh        &fibers,
                 const MatrixMesh       &matrix,
                 const DofVector        &q);
} // namespace fiberloom

#endif
