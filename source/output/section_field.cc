// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/output/fiber_samples.h>
#include <fiberloom/output/field_arrays.h>
#include <fiberloom/output/section_field.h>
#include <fiberloom/output/section_skin.h>

#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkIdList.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

namespace fiberloom
{
  namespace
  {
    /** Adds the faces of @p skin, whose points start at @p first . */
    unsigned int
    insert_skin_cells(vtkUnstructuredGrid *grid,
                      const SectionSkin   &skin,
                      const vtkIdType      first)
    {
      for (unsigned int i = 0; i + 1 < skin.n_rings; ++i)
        for (unsigned int j = 0; j < skin.n_around; ++j)
          {
            std::array<vtkIdType, 4> corners;
            for (unsigned int c = 0; c < 4; ++c)
              corners[c] = first + skin.face(i, j)[c];
            grid->InsertNextCell(VTK_QUAD, 4, corners.data());
          }

      vtkNew<vtkIdList> start, end;
      for (unsigned int j = 0; j < skin.n_around; ++j)
        {
          start->InsertNextId(first + skin.n_around - 1 - j);
          end->InsertNextId(first + (skin.n_rings - 1) * skin.n_around + j);
        }
      grid->InsertNextCell(VTK_POLYGON, start);
      grid->InsertNextCell(VTK_POLYGON, end);
      return (skin.n_rings - 1) * skin.n_around + 2;
    }
  } // namespace



  vtkSmartPointer<vtkUnstructuredGrid>
  section_field(const FiberMesh   &mesh,
                const State       &state,
                const unsigned int begin,
                const unsigned int end,
                const unsigned int n_around)
  {
    auto              grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    vtkNew<vtkPoints> points;
    grid->SetPoints(points);

    auto *point_data = grid->GetPointData();
    auto *cell_data  = grid->GetCellData();
    auto  forces = add_field_array<vtkFloatArray>(point_data, "axial_force");
    auto  curvatures = add_field_array<vtkFloatArray>(point_data, "curvature");
    auto  tows       = add_field_array<vtkIntArray>(cell_data, "tow");
    auto  fibers     = add_field_array<vtkIntArray>(cell_data, "fiber");

    for (unsigned int f = begin; f < end; ++f)
      {
        std::vector<Section> sections;
        for (const FiberSample &sample :
             sample_fiber(mesh, state.q, f, 4, state.fibers))
          {
            sections.push_back(sample.section);
            for (unsigned int j = 0; j < n_around; ++j)
              {
                forces->InsertNextValue(sample.axial_force);
                curvatures->InsertNextValue(sample.curvature);
              }
          }

        const SectionSkin skin(sections, n_around);
        const vtkIdType   first = points->GetNumberOfPoints();
        for (const Vector3 &point : skin.points)
          points->InsertNextPoint(point.data());

        const unsigned int n_cells = insert_skin_cells(grid, skin, first);
        for (unsigned int c = 0; c < n_cells; ++c)
          {
            tows->InsertNextValue(mesh.lines()[f].tow);
            fibers->InsertNextValue(f);
          }
      }
    return grid;
  }
} // namespace fiberloom
