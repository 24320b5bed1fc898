// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/output/field_arrays.h>
#include <fiberloom/output/voxels.h>
#include <fiberloom/output/xml_content.h>

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkXMLImageDataWriter.h>

namespace fiberloom
{
  std::string
  voxels_vti(const VoxelGrid &grid)
  {
    const Lattice       &centers = grid.centers;
    vtkNew<vtkImageData> image;
    image->SetDimensions(centers.n[0] + 1, centers.n[1] + 1, centers.n[2] + 1);
    image->SetSpacing(centers.spacing, centers.spacing, centers.spacing);
    const Vector3 corner =
      centers.origin - Vector3::Constant(.5 * centers.spacing);
    image->SetOrigin(corner.data());

    auto *data = image->GetCellData();
    auto  tows = add_field_array<vtkIntArray>(data, "tow");
    auto  fractions =
      add_field_array<vtkDoubleArray>(data, "fiber_volume_fraction");
    auto orientations = add_field_array<vtkDoubleArray>(data, "orientation", 3);
    for (std::size_t v = 0; v < grid.tows.size(); ++v)
      {
        tows->InsertNextValue(grid.tows[v]);
        fractions->InsertNextValue(grid.fractions[v]);
        append_vector(orientations, grid.orientations[v]);
      }
    return xml_content<vtkXMLImageDataWriter>(image.Get());
  }
} // namespace fiberloom
