// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/output/fiber_samples.h>
#include <fiberloom/output/field_arrays.h>
#include <fiberloom/output/section_skin.h>
#include <fiberloom/output/slices.h>
#include <fiberloom/output/xml_content.h>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCutter.h>
#include <vtkIdList.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStripper.h>
#include <vtkXMLPolyDataWriter.h>

#include <cmath>

namespace fiberloom
{
  namespace
  {
    // 2 an element would show corners where a fiber is cut lengthwise
    constexpr unsigned int slice_intervals = 6;

    void
    insert_triangle(vtkCellArray   *cells,
                    const vtkIdType a,
                    const vtkIdType b,
                    const vtkIdType c)
    {
      const std::array<vtkIdType, 3> corners{{a, b, c}};
      cells->InsertNextCell(3, corners.data());
    }

    void
    insert_cap(vtkCellArray *cells, const SectionSkin &skin, const vtkIdType i)
    {
      for (unsigned int j = 1; j + 1 < skin.n_around; ++j)
        insert_triangle(cells,
                        i * skin.n_around,
                        i * skin.n_around + j,
                        i * skin.n_around + j + 1);
    }

    /** Distances of a ring of the skin from the plane: smallest and largest. */
    std::array<double, 2>
    ring_distances(const SectionSkin &skin,
                   const SlicePlane  &plane,
                   const unsigned int ring)
    {
      const Vector3         normal = plane.normal();
      std::array<double, 2> range{{1e300, -1e300}};
      for (unsigned int j = 0; j < skin.n_around; ++j)
        {
          const double distance =
            normal.dot(skin.points[ring * skin.n_around + j] - plane.origin);
          range[0] = std::min(range[0], distance);
          range[1] = std::max(range[1], distance);
        }
      return range;
    }

    /**
     * The triangles of the skin that can meet the plane; all others are left
     * out, which for a sample of many fibers are nearly all.
     */
    vtkSmartPointer<vtkPolyData>
    skin_near_plane(const SectionSkin &skin, const SlicePlane &plane)
    {
      std::vector<std::array<double, 2>> distances;
      for (unsigned int i = 0; i < skin.n_rings; ++i)
        distances.push_back(ring_distances(skin, plane, i));

      vtkNew<vtkCellArray> cells;
      for (unsigned int i = 0; i + 1 < skin.n_rings; ++i)
        if (std::min(distances[i][0], distances[i + 1][0]) <= 0 &&
            std::max(distances[i][1], distances[i + 1][1]) >= 0)
          for (unsigned int j = 0; j < skin.n_around; ++j)
            {
              const auto face = skin.face(i, j);
              insert_triangle(cells, face[0], face[1], face[2]);
              insert_triangle(cells, face[0], face[2], face[3]);
            }
      for (const unsigned int i : {0u, skin.n_rings - 1})
        if (distances[i][0] <= 0 && distances[i][1] >= 0)
          insert_cap(cells, skin, i);

      auto result = vtkSmartPointer<vtkPolyData>::New();
      if (cells->GetNumberOfCells() == 0)
        return result;
      vtkNew<vtkPoints> points;
      points->SetDataTypeToDouble();
      for (const Vector3 &point : skin.points)
        points->InsertNextPoint(point.data());
      result->SetPoints(points);
      result->SetPolys(cells);
      return result;
    }

    vtkSmartPointer<vtkPolyData>
    closed_lines(vtkPolyData *skin, const SlicePlane &plane)
    {
      vtkNew<vtkPlane> function;
      function->SetOrigin(plane.origin[0], plane.origin[1], plane.origin[2]);
      const Vector3 normal = plane.normal();
      function->SetNormal(normal[0], normal[1], normal[2]);

      vtkNew<vtkCutter> cutter;
      cutter->SetCutFunction(function);
      cutter->SetInputData(skin);
      cutter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);

      vtkNew<vtkStripper> stripper;
      stripper->SetInputConnection(cutter->GetOutputPort());
      stripper->SetMaximumLength(1000000);
      stripper->JoinContiguousSegmentsOn();
      stripper->Update();
      return stripper->GetOutput();
    }

    std::vector<std::array<double, 2>>
    outline_points(vtkPolyData      *lines,
                   vtkIdList        *corners,
                   const SlicePlane &plane)
    {
      std::vector<std::array<double, 2>> points;
      for (vtkIdType i = 0; i < corners->GetNumberOfIds(); ++i)
        {
          const Vector3 position =
            Eigen::Map<const Vector3>(lines->GetPoint(corners->GetId(i))) -
            plane.origin;
          points.push_back(
            {{position.dot(plane.along), position.dot(plane.up)}});
        }
      if (points.size() > 1 && points.front() == points.back())
        points.pop_back();
      return points;
    }
  } // namespace



  std::vector<SliceOutline>
  cut_fibers(const FiberMesh   &mesh,
             const DofVector   &q,
             const SlicePlane  &plane,
             const unsigned int n_around)
  {
    // A vertex of the skin exactly on the plane would make loops of length
    // zero, and flat fabrics are full of symmetric planes.
    SlicePlane shifted = plane;

    std::vector<SliceOutline> outlines;
    for (unsigned int f = 0; f < mesh.lines().size(); ++f)
      {
        shifted.origin =
          plane.origin + 1.234567e-7 * mesh.lines()[f].radius * plane.normal();
        const SectionSkin skin(sample_sections(mesh, q, f, slice_intervals),
                               n_around);
        const auto        surface = skin_near_plane(skin, shifted);
        if (surface->GetNumberOfCells() == 0)
          continue;
        const auto lines = closed_lines(surface, shifted);

        vtkNew<vtkIdList> corners;
        lines->GetLines()->InitTraversal();
        while (lines->GetLines()->GetNextCell(corners))
          {
            SliceOutline outline{f, outline_points(lines, corners, plane)};
            if (outline.points.size() > 2)
              outlines.push_back(outline);
          }
      }
    return outlines;
  }



  double
  enclosed_area(const SliceOutline &outline)
  {
    double     area = 0;
    const auto n    = outline.points.size();
    for (std::size_t i = 0; i < n; ++i)
      {
        const auto &a = outline.points[i];
        const auto &b = outline.points[(i + 1) % n];
        area += .5 * (a[0] * b[1] - a[1] * b[0]);
      }
    return std::abs(area);
  }



  std::string
  slice_polydata(const FiberSet                  &fibers,
                 const SlicePlane                &plane,
                 const std::vector<SliceOutline> &outlines)
  {
    vtkNew<vtkPolyData>  data;
    vtkNew<vtkPoints>    points;
    vtkNew<vtkCellArray> polygons;
    points->SetDataTypeToDouble();
    auto tow   = add_field_array<vtkIntArray>(data->GetCellData(), "tow");
    auto fiber = add_field_array<vtkIntArray>(data->GetCellData(), "fiber");

    vtkNew<vtkIdList> corners;
    for (const SliceOutline &outline : outlines)
      {
        corners->Reset();
        for (const auto &point : outline.points)
          {
            const Vector3 position =
              plane.origin + point[0] * plane.along + point[1] * plane.up;
            corners->InsertNextId(points->InsertNextPoint(position.data()));
          }
        polygons->InsertNextCell(corners);
        tow->InsertNextValue(fibers.fibers[outline.fiber].tow);
        fiber->InsertNextValue(outline.fiber);
      }
    data->SetPoints(points);
    data->SetPolys(polygons);

    return xml_content<vtkXMLPolyDataWriter>(data);
  }
} // namespace fiberloom
