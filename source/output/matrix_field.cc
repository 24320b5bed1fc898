// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/output/field_arrays.h>
#include <fiberloom/output/matrix_field.h>

#include <Eigen/LU>

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

#include <array>

namespace fiberloom
{
  namespace
  {
    void
    append_tensor(vtkDoubleArray &array, const Matrix3 &tensor)
    {
      array.InsertNextTuple(tensor.data()); // symmetric: rows are columns
    }

    /** Number in the cell of its node at (i, j, k), each 0 to the degree, in
     * deal.II's order: vertices, lines, faces, the middle. */
    unsigned int
    node_of_cell(const unsigned int degree,
                 const unsigned int i,
                 const unsigned int j,
                 const unsigned int k)
    {
      if (degree == 1)
        return i + 2 * j + 4 * k;
      constexpr std::array<unsigned int, 27> numbers{
        {0,  10, 1,  8,  24, 9,  2, 11, 3,  16, 22, 17, 20, 26,
         21, 18, 23, 19, 4,  14, 5, 12, 25, 13, 6,  15, 7}};
      return numbers[i + 3 * j + 9 * k];
    }

    void
    append_cells(vtkUnstructuredGrid &grid,
                 const unsigned int   degree,
                 const vtkIdType      first)
    {
      for (unsigned int k = 0; k < degree; ++k)
        for (unsigned int j = 0; j < degree; ++j)
          for (unsigned int i = 0; i < degree; ++i)
            {
              std::array<vtkIdType, 8> corners;
              for (unsigned int v = 0; v < 8; ++v)
                {
                  // VTK goes around each face.
                  const unsigned int a = v % 4 == 1 || v % 4 == 2;
                  corners[v] =
                    first +
                    node_of_cell(degree, i + a, j + v % 4 / 2, k + v / 4);
                }
              grid.InsertNextCell(VTK_HEXAHEDRON, 8, corners.data());
            }
    }
  } // namespace



  vtkSmartPointer<vtkUnstructuredGrid>
  matrix_field(const Composite  &composite,
               const DofVector  &q,
               const std::size_t begin,
               const std::size_t end)
  {
    auto              grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    grid->SetPoints(points);
    auto *data = grid->GetPointData();
    auto  displacement =
      add_field_array<vtkDoubleArray>(data, "displacement", 3);
    auto strain = add_field_array<vtkDoubleArray>(data, "strain", 9);
    auto stress = add_field_array<vtkDoubleArray>(data, "stress", 9);

    const MatrixMesh     &matrix    = composite.matrix();
    const Eigen::VectorXd positions = composite.positions(q);
    for (std::size_t c = begin; c < end; ++c)
      {
        const vtkIdType first = points->GetNumberOfPoints();
        const auto     &nodes = matrix.nodes(c);
        for (unsigned int a = 0; a < nodes.size(); ++a)
          {
            const Vector3 x = positions.segment<3>(3 * nodes[a]);
            points->InsertNextPoint(x.data());
            append_vector(displacement,
                          x - matrix.reference().segment<3>(3 * nodes[a]));
            const Matrix3 F = matrix.deformation_gradient(positions, c, a);
            append_tensor(*strain,
                          .5 * (F.transpose() * F - Matrix3::Identity()));
            append_tensor(*stress,
                          F * symmetric_matrix(matrix.law().stress(F)) *
                            F.transpose() / F.determinant());
          }
        append_cells(*grid, matrix.degree(), first);
      }
    return grid;
  }



  vtkSmartPointer<vtkUnstructuredGrid>
  junction_field(const Composite  &composite,
                 const DofVector  &q,
                 const std::size_t begin,
                 const std::size_t end)
  {
    auto              grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    grid->SetPoints(points);
    auto force =
      add_field_array<vtkDoubleArray>(grid->GetCellData(), "force", 3);

    const Eigen::VectorXd positions = composite.positions(q);
    for (std::size_t j = begin; j < end; ++j)
      {
        const JunctionElement         &junction = composite.junctions()[j];
        const std::array<vtkIdType, 2> ends{
          {points->InsertNextPoint(junction.fiber_particle(q).data()),
           points->InsertNextPoint(
             junction.matrix_particle(positions).data())}};
        grid->InsertNextCell(VTK_LINE, 2, ends.data());
        append_vector(force, composite.junction_force(j, q));
      }
    return grid;
  }
} // namespace fiberloom
