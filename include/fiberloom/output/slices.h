// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_slices_h
#define fiberloom_output_slices_h

#include <fiberloom/base/choices.h>

#include <fiberloom/fabric/fiber_set.h>

#include <fiberloom/beams/fiber_mesh.h>

#include <array>
#include <string>
#include <vector>

namespace fiberloom
{
  /** A plane with its own axes: along the picture, and up. */
  struct SlicePlane
  {
    std::string name;  // of the files
    std::string title; // for the reader
    Vector3     origin;
    Vector3     along; // unit
    Vector3     up;    // unit

    Vector3
    normal() const
    {
      return along.cross(up);
    }
  };

  /** The closed line in which the plane cuts the skin of one fiber [mm]. */
  struct SliceOutline
  {
    unsigned int                       fiber;
    std::vector<std::array<double, 2>> points; // along, up
  };

  /**
   * The planes that show most of the sample at @p q . In a fabric, along the
   * middle tow of each family that @p which names (warp, fill, both, none): it
   * shows that tow lengthwise, over and under the crossing ones, which are cut
   * across. It stands beside the tow's axis by a quarter of the spacing of its
   * fibers, so that it meets all of the staggered layers. Other fibers are cut
   * across the first one, at its middle.
   */
  std::vector<SlicePlane>
  slice_planes(const FiberSet  &fibers,
               const FiberMesh &mesh,
               const DofVector &q,
               const Slices     which);

  /** Cuts the deformed fibers, whose sections get @p n_around points. */
  std::vector<SliceOutline>
  cut_fibers(const FiberMesh   &mesh,
             const DofVector   &q,
             const SlicePlane  &plane,
             const unsigned int n_around = 32);

  /** Area inside an outline [mm^2]. */
  double
  enclosed_area(const SliceOutline &outline);

  /** The outlines as polygons in space with cell data tow and fiber (.vtp). */
  std::string
  slice_polydata(const FiberSet                  &fibers,
                 const SlicePlane                &plane,
                 const std::vector<SliceOutline> &outlines);

  /**
   * The outlines as SVG: equal axes, warp and fill in their colours, a bar of
   * length, and a title.
   */
  std::string
  slice_picture(const FiberSet                  &fibers,
                const std::vector<SliceOutline> &outlines,
                const std::string               &title);
} // namespace fiberloom

#endif
