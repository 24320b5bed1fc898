// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/output/fiber_field.h>
#include <fiberloom/output/fiber_lines.h>
#include <fiberloom/output/field_arrays.h>
#include <fiberloom/output/xml_content.h>

#include <vtkCellData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

namespace fiberloom
{
  std::string
  fibers_vtp(const FiberSet &fibers, const FiberMesh &mesh, const DofVector &q)
  {
    const auto          field = fiber_field(mesh, q, 0, mesh.lines().size());
    vtkNew<vtkPolyData> lines;
    lines->SetPoints(field->GetPoints());
    lines->SetLines(field->GetCells());
    lines->GetPointData()->ShallowCopy(field->GetPointData());
    lines->GetCellData()->ShallowCopy(field->GetCellData());
    auto families =
      add_field_array<vtkIntArray>(lines->GetCellData(), "family");
    for (const auto &line : mesh.lines())
      families->InsertNextValue(static_cast<int>(fibers.tows[line.tow].family));
    return xml_content<vtkXMLPolyDataWriter>(lines.Get());
  }
} // namespace fiberloom
