// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_voxel_deck_h
#define fiberloom_output_voxel_deck_h

#include <fiberloom/fabric/fiber_set.h>

#include <fiberloom/output/voxels.h>

#include <string>

namespace fiberloom
{
  /** Elastic constants of an isotropic matrix. */
  struct MatrixConstants
  {
    double young_modulus; // [MPa]
    double poisson_ratio;
  };

  /** Elastic constants of a tow: fibers along the first axis in a matrix. */
  struct TowConstants
  {
    double young_modulus_1, young_modulus_2; // [MPa]
    double poisson_ratio_12, poisson_ratio_23;
    double shear_modulus_12, shear_modulus_23; // [MPa]
  };

  /**
   * Chamis' formulas (1984, eqs. 2 to 7) for a fiber volume fraction of at most
   * 1 and isotropic fibers.
   */
  TowConstants
  tow_constants(const Fiber           &fiber,
                const MatrixConstants &matrix,
                const double           fraction);

  /**
   * A deck for Abaqus and CalculiX: a C3D8 for each voxel, element sets of each
   * tow and of the matrix, directions of the fibers, node sets of the faces,
   * edges and corners in matching order, and a pull by 0.1 % along x as a step
   * to start from. Units are mm, N, MPa.
   */
  std::string
  voxel_deck(const VoxelGrid       &grid,
             const FiberSet        &fibers,
             const MatrixConstants &matrix);
} // namespace fiberloom

#endif
