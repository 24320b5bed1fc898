// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_voxels_h
#define fiberloom_output_voxels_h

#include <fiberloom/output/tow_shape.h>

#include <string>
#include <vector>

namespace fiberloom
{
  /** Cubes that fill the box around all tows, and what is in each of them. */
  struct VoxelGrid
  {
    Lattice              centers;
    std::vector<int>     tows;         // whose region has the center, else -1
    std::vector<double>  fractions;    // volume of fibers over that of the cube
    std::vector<Vector3> orientations; // unit, of the fibers inside, else of
                                       // the tow, else 0
    std::vector<double> tow_volumes;   // of the fibers of each tow [mm^3]

    /** Volume of a voxel [mm^3]. */
    double
    cube() const
    {
      return centers.spacing * centers.spacing * centers.spacing;
    }
  };

  /**
   * The edge of voxels [mm] that @p wanted asks for; where it is 0 @p radius ,
   * or as much more as leaves a million voxels in @p box .
   */
  double
  voxel_size(const double                  wanted,
             const double                  radius,
             const std::array<Vector3, 2> &box);

  /**
   * Each piece of a fiber goes to the voxel in which it is, so that the sum of
   * all volumes is that of the fibers. @p shapes are those of all tows.
   */
  VoxelGrid
  fill_voxels(const FiberMesh             &mesh,
              const DofVector             &q,
              const std::vector<TowShape> &shapes,
              const double                 size);

  /**
   * @p grid as an image of VTK (.vti) with cell data tow, fiber_volume_fraction
   * and orientation.
   */
  std::string
  voxels_vti(const VoxelGrid &grid);
} // namespace fiberloom

#endif
