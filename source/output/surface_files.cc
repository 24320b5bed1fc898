// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>

#include <fiberloom/output/field_arrays.h>
#include <fiberloom/output/files.h>
#include <fiberloom/output/tow_surface.h>
#include <fiberloom/output/xml_content.h>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSTLWriter.h>
#include <vtkSmartPointer.h>
#include <vtkXMLPolyDataWriter.h>

#include <cstdio>

namespace fiberloom
{
  namespace
  {
    vtkSmartPointer<vtkPolyData>
    poly_data(const std::vector<TowSurface> &surfaces)
    {
      auto                 data = vtkSmartPointer<vtkPolyData>::New();
      vtkNew<vtkPoints>    points;
      vtkNew<vtkCellArray> triangles;
      points->SetDataTypeToDouble();
      auto tows = add_field_array<vtkIntArray>(data->GetCellData(), "tow");
      for (std::size_t t = 0; t < surfaces.size(); ++t)
        {
          const vtkIdType first = points->GetNumberOfPoints();
          for (const Vector3 &point : surfaces[t].points)
            points->InsertNextPoint(point.data());
          for (const auto &triangle : surfaces[t].triangles)
            {
              const vtkIdType corners[3] = {first + triangle[0],
                                            first + triangle[1],
                                            first + triangle[2]};
              triangles->InsertNextCell(3, corners);
              tows->InsertNextValue(t);
            }
        }
      data->SetPoints(points);
      data->SetPolys(triangles);
      return data;
    }
  } // namespace



  std::string
  surfaces_vtp(const std::vector<TowSurface> &surfaces)
  {
    return xml_content<vtkXMLPolyDataWriter>(poly_data(surfaces));
  }



  void
  write_surfaces_stl(const std::string             &file,
                     const std::vector<TowSurface> &surfaces)
  {
    const std::string    aside = file + ".tmp";
    vtkNew<vtkSTLWriter> writer;
    writer->SetInputData(poly_data(surfaces));
    writer->SetFileName(aside.c_str());
    writer->SetFileTypeToBinary();
    if (writer->Write() == 0 || writer->GetErrorCode() != 0)
      {
        std::remove(aside.c_str());
        throw StageFailure("cannot write " + file);
      }
    rename_file(aside, file);
  }
} // namespace fiberloom
