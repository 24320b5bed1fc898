// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_base_vector_types_h
#define fiberloom_base_vector_types_h

#include <Eigen/Core>

namespace fiberloom
{
  using Vector3 = Eigen::Vector3d;
  using Matrix3 = Eigen::Matrix3d;

  /** Fiber dofs of the whole sample, nine a node, see FiberMesh. */
  using DofVector = Eigen::VectorXd;
} // namespace fiberloom

#endif
