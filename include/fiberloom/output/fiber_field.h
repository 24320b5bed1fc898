// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_fiber_field_h
#define fiberloom_output_fiber_field_h

#include <fiberloom/beams/fiber_mesh.h>

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

namespace fiberloom
{
  /**
   * The fibers @p begin to @p end as polylines with four intervals an element.
   * Point data: radius, displacement, section_vector_1 and _2 (g1, g2, free
   * of units), axial_force [N], bending_moment and torque [N mm], curvature
   * [1/mm], tow, fiber. Cell data: tow, fiber. Where @p history is given, point
   * data have broken, too, 1 on elements that are.
   */
  vtkSmartPointer<vtkUnstructuredGrid>
  fiber_field(const FiberMesh    &mesh,
              const DofVector    &q,
              const unsigned int  begin,
              const unsigned int  end,
              const FiberHistory *history = nullptr);
} // namespace fiberloom

#endif
