// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/output/fiber_field.h>
#include <fiberloom/output/fiber_samples.h>
#include <fiberloom/output/field_arrays.h>

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

namespace fiberloom
{
  namespace
  {
    using Doubles  = vtkSmartPointer<vtkDoubleArray>;
    using Integers = vtkSmartPointer<vtkIntArray>;

    constexpr unsigned int n_intervals = 4; // of an element

    struct FiberPointData
    {
      explicit FiberPointData(vtkPointData *data)
        : radius(add_field_array<vtkDoubleArray>(data, "radius"))
        , displacement(add_field_array<vtkDoubleArray>(data, "displacement", 3))
        , vector_1(add_field_array<vtkDoubleArray>(data, "section_vector_1", 3))
        , vector_2(add_field_array<vtkDoubleArray>(data, "section_vector_2", 3))
        , axial_force(add_field_array<vtkDoubleArray>(data, "axial_force"))
        , bending_moment(
            add_field_array<vtkDoubleArray>(data, "bending_moment", 3))
        , torque(add_field_array<vtkDoubleArray>(data, "torque"))
        , curvature(add_field_array<vtkDoubleArray>(data, "curvature"))
        , tow(add_field_array<vtkIntArray>(data, "tow"))
        , fiber(add_field_array<vtkIntArray>(data, "fiber"))
      {}

      void
      append(const FiberSample     &sample,
             const FiberMesh::Line &line,
             const unsigned int     fiber_number)
      {
        radius->InsertNextValue(line.radius);
        append_vector(displacement, sample.displacement);
        append_vector(vector_1, sample.section.vector_1 / line.radius);
        append_vector(vector_2, sample.section.vector_2 / line.radius);
        axial_force->InsertNextValue(sample.axial_force);
        append_vector(bending_moment, sample.bending_moment);
        torque->InsertNextValue(sample.torque);
        curvature->InsertNextValue(sample.curvature);
        tow->InsertNextValue(line.tow);
        fiber->InsertNextValue(fiber_number);
      }

      Doubles  radius, displacement, vector_1, vector_2;
      Doubles  axial_force, bending_moment, torque, curvature;
      Integers tow, fiber;
    };

    void
    append_broken(vtkIntArray           *broken,
                  const FiberMesh::Line &line,
                  const FiberHistory    &history)
    {
      for (unsigned int i = 0; i <= n_intervals * line.n_elements; ++i)
        {
          // A point between two elements belongs to both.
          const unsigned int after  = i / n_intervals,
                             before = (i + n_intervals - 1) / n_intervals;
          broken->InsertNextValue(
            (after < line.n_elements &&
             history.is_broken(line.first_element + after)) ||
            (before > 0 && history.is_broken(line.first_element + before - 1)));
        }
    }
  } // namespace



  vtkSmartPointer<vtkUnstructuredGrid>
  fiber_field(const FiberMesh    &mesh,
              const DofVector    &q,
              const unsigned int  begin,
              const unsigned int  end,
              const FiberHistory *history)
  {
    auto              grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    grid->SetPoints(points);

    FiberPointData point_data(grid->GetPointData());
    const Integers broken =
      history ? add_field_array<vtkIntArray>(grid->GetPointData(), "broken") :
                nullptr;
    auto tows   = add_field_array<vtkIntArray>(grid->GetCellData(), "tow");
    auto fibers = add_field_array<vtkIntArray>(grid->GetCellData(), "fiber");

    vtkNew<vtkIdList> corners;
    for (unsigned int f = begin; f < end; ++f)
      {
        corners->Reset();
        for (const FiberSample &sample : sample_fiber(
               mesh, q, f, n_intervals, history ? *history : FiberHistory()))
          {
            corners->InsertNextId(
              points->InsertNextPoint(sample.section.center.data()));
            point_data.append(sample, mesh.lines()[f], f);
          }
        if (history)
          append_broken(broken, mesh.lines()[f], *history);
        grid->InsertNextCell(VTK_POLY_LINE, corners);
        tows->InsertNextValue(mesh.lines()[f].tow);
        fibers->InsertNextValue(f);
      }
    return grid;
  }
} // namespace fiberloom
