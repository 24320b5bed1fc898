// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_section_field_h
#define fiberloom_output_section_field_h

#include <fiberloom/beams/fiber_mesh.h>

#include <fiberloom/model/state.h>

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

namespace fiberloom
{
  /**
   * The skin of the deformed fibers @p begin to @p end: quadrilaterals with
   * @p n_around points around a section and four intervals an element, closed
   * by a polygon at each end. Point data: axial_force [N], curvature [1/mm];
   * cell data: tow, fiber.
   */
  vtkSmartPointer<vtkUnstructuredGrid>
  section_field(const FiberMesh   &mesh,
                const State       &state,
                const unsigned int begin,
                const unsigned int end,
                const unsigned int n_around);
} // namespace fiberloom

#endif
