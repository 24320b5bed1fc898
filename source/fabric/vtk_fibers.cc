// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>

#include <fiberloom/fabric/vtk_fibers.h>

#include <vtkCallbackCommand.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <filesystem>

namespace fiberloom
{
  namespace
  {
    void
    ignore(vtkObject *, unsigned long, void *, void *)
    {}

    template <class Reader>
    vtkSmartPointer<vtkPointSet>
    read_with(const std::string &file)
    {
      // an observer keeps the reader's own messages off the screen
      vtkNew<vtkCallbackCommand> silence;
      silence->SetCallback(ignore);
      vtkNew<Reader> reader;
      reader->AddObserver(vtkCommand::ErrorEvent, silence);
      reader->SetParserErrorObserver(silence);
      reader->SetReaderErrorObserver(silence);
      reader->SetFileName(file.c_str());
      if (reader->CanReadFile(file.c_str()) != 0)
        reader->Update();
      if (reader->GetErrorCode() != 0 || reader->GetOutput() == nullptr ||
          reader->GetOutput()->GetNumberOfPoints() == 0)
        throw InputError("is no file of its kind with points, or is damaged; "
                         "allowed: XML files of VTK");
      return reader->GetOutput();
    }

    vtkSmartPointer<vtkPointSet>
    read_points(const std::string &file)
    {
      if (std::filesystem::path(file).extension() == ".vtp")
        return read_with<vtkXMLPolyDataReader>(file);
      return read_with<vtkXMLUnstructuredGridReader>(file);
    }

    std::optional<double>
    value_of_cell(vtkPointSet       &grid,
                  vtkCell           &cell,
                  const vtkIdType    number,
                  const std::string &name)
    {
      if (vtkDataArray *array = grid.GetCellData()->GetArray(name.c_str()))
        return array->GetComponent(number, 0);
      vtkDataArray *array = grid.GetPointData()->GetArray(name.c_str());
      if (array == nullptr)
        return {};
      const double value = array->GetComponent(cell.GetPointId(0), 0);
      for (vtkIdType p = 1; p < cell.GetNumberOfPoints(); ++p)
        if (array->GetComponent(cell.GetPointId(p), 0) != value)
          throw InputError("fiber " + std::to_string(number) + ": " + name +
                           " changes along it; allowed: one value a fiber");
      return value;
    }
  } // namespace



  std::vector<FiberPoints>
  read_vtk_fibers(const std::string &file)
  {
    const auto               grid = read_points(file);
    std::vector<FiberPoints> fibers;
    for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
      {
        vtkCell *cell = grid->GetCell(c);
        if (cell->GetCellType() != VTK_LINE &&
            cell->GetCellType() != VTK_POLY_LINE)
          throw InputError("cell " + std::to_string(c) +
                           " is no line; allowed: lines and polylines");
        FiberPoints fiber;
        for (vtkIdType p = 0; p < cell->GetNumberOfPoints(); ++p)
          {
            Vector3 point;
            grid->GetPoint(cell->GetPointId(p), point.data());
            fiber.points.push_back(point);
          }
        for (std::size_t v = 0; v < fiber.values.size(); ++v)
          fiber.values[v] =
            value_of_cell(*grid, *cell, c, FiberPoints::value_names[v]);
        fibers.push_back(fiber);
      }
    return fibers;
  }
} // namespace fiberloom
