// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_matrix_field_h
#define fiberloom_output_matrix_field_h

#include <fiberloom/model/composite.h>

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

namespace fiberloom
{
  /**
   * Cells @p begin to @p end of the matrix, cells of degree 2 as eight straight
   * ones, at their places for the dofs @p q of a state. Point data:
   * displacement [mm], Green-Lagrange strain and Cauchy stress [MPa] as tensors
   * of nine components. Points are not shared between cells, where strain and
   * stress jump.
   */
  vtkSmartPointer<vtkUnstructuredGrid>
  matrix_field(const Composite  &composite,
               const DofVector  &q,
               const std::size_t begin,
               const std::size_t end);

  /**
   * The junctions @p begin to @p end as lines from the fiber's particle to that
   * of the matrix. Cell data: force on the fiber (vector, [N]).
   */
  vtkSmartPointer<vtkUnstructuredGrid>
  junction_field(const Composite  &composite,
                 const DofVector  &q,
                 const std::size_t begin,
                 const std::size_t end);
} // namespace fiberloom

#endif
