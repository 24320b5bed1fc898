// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_tests_dense_beams_h
#define fiberloom_tests_dense_beams_h

#include <fiberloom/beams/fiber_mesh.h>

#include <Eigen/Dense>

#include <vector>

/** Residual and tangent of all fibers at @p q , as dense matrices. */
inline void
assemble_dense(const fiberloom::FiberMesh &mesh,
               const Eigen::VectorXd      &q,
               Eigen::VectorXd            &residual,
               Eigen::MatrixXd            &tangent)
{
  residual.setZero(q.size());
  tangent.setZero(q.size(), q.size());
  for (unsigned int e = 0; e < mesh.n_elements(); ++e)
    {
      fiberloom::BeamElement::Vector r;
      fiberloom::BeamElement::Matrix K;
      mesh.element(e).residual_and_tangent(mesh.element_dofs(q, e), r, K);
      const unsigned int first = 9 * mesh.first_node(e);
      residual.segment<27>(first) += r;
      tangent.block<27, 27>(first, first) += K;
    }
}

/** K u = f with the dofs in @p fixed at zero. */
inline Eigen::VectorXd
solve_dense(Eigen::MatrixXd                  tangent,
            Eigen::VectorXd                  force,
            const std::vector<unsigned int> &fixed)
{
  const double scale = tangent.diagonal().mean();
  for (const unsigned int dof : fixed)
    {
      tangent.row(dof).setZero();
      tangent.col(dof).setZero();
      tangent(dof, dof) = scale;
      force[dof]        = 0;
    }
  return tangent.ldlt().solve(force);
}

#endif
