// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_simulation_refinement_h
#define fiberloom_simulation_refinement_h

#include <fiberloom/base/parameters.h>

#include <fiberloom/stages/stage.h>

#include <memory>
#include <vector>

namespace fiberloom
{
  /** What is finer than in the scene. */
  struct Refinement
  {
    unsigned int elements  = 1; // of fibers, for one
    double       stations  = 1; // over the length, for one
    double       stiffness = 1;
    unsigned int cells     = 1; // of the matrix along each direction, for one
  };

  /** Tolerances of a refined scene over those by which a state was found. */
  constexpr double tighter = .1;

  /** The parameters of a finer scene, with tighter tolerances. */
  Parameters
  refine(Parameters parameters, const Refinement &refinement);

  /** Carries states over to finer meshes: where material points are does not
   * change but for the curvature of the reference. */
  class Transfer
  {
  public:
    /**
     * Carries states over to the mesh @p fine of the fibers, with @p matrix as
     * in the states. By how much elements of fibers are shorter is taken from
     * the meshes.
     */
    Transfer(const Scene       &scene,
             const MatrixState &matrix,
             const FiberMesh   &fine,
             const Refinement  &refinement);

    /** @p state , carried over to the finer meshes. */
    State
    operator()(State state) const;

    /** The finer composite, as long as this lives; null without matrix. */
    const Composite *
    finer() const
    {
      return finer_composite.get();
    }

  private:
    /** Elements of the finer mesh for one of @p fiber . */
    double
    ratio(const unsigned int fiber) const;

    DofVector
    fiber_dofs(const DofVector &q) const;

    /**
     * @p history on the finer mesh: all elements in the place of a broken one
     * are broken.
     */
    FiberHistory
    fiber_history(const FiberHistory &history) const;

    Eigen::VectorXd
    matrix_dofs(const DofVector &q) const;

    void
    refine_cells();

    const FiberMesh           &coarse;
    const Composite           *composite; // the coarse one; null without matrix
    const FiberMesh           &fine;
    const Refinement          &refinement;
    MatrixState                finer_matrix;
    std::unique_ptr<Composite> finer_composite;
    std::vector<CellPoint>     places; // of its nodes, in the coarse one
  };
} // namespace fiberloom

#endif
