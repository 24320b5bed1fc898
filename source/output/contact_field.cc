// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/output/contact_field.h>
#include <fiberloom/output/field_arrays.h>

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>

namespace fiberloom
{
  Vector3
  particle_position(const FiberMesh      &mesh,
                    const DofVector      &q,
                    const ContactElement &contact,
                    const unsigned int    s)
  {
    const Section section = mesh.section(q, contact.points[s]);
    return section.center + contact.particles[s][0] * section.vector_1 +
           contact.particles[s][1] * section.vector_2;
  }



  vtkSmartPointer<vtkUnstructuredGrid>
  contact_field(const FiberMesh                   &cell,
                const DofVector                   &q_of_cell,
                const std::vector<ContactElement> &contacts,
                const std::size_t                  begin,
                const std::size_t                  end)
  {
    const FiberMesh  &mesh     = cell.with_images();
    const DofVector   q        = cell.with_images(q_of_cell);
    const int         n_fibers = cell.lines().size();
    auto              grid     = vtkSmartPointer<vtkUnstructuredGrid>::New();
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    grid->SetPoints(points);

    auto *data     = grid->GetCellData();
    auto  gap      = add_field_array<vtkDoubleArray>(data, "gap");
    auto  normal   = add_field_array<vtkDoubleArray>(data, "normal_force", 3);
    auto  friction = add_field_array<vtkDoubleArray>(data, "friction_force", 3);
    auto  status   = add_field_array<vtkIntArray>(data, "status");
    auto  zone     = add_field_array<vtkIntArray>(data, "zone");
    auto  first    = add_field_array<vtkIntArray>(data, "first_fiber");
    auto  second   = add_field_array<vtkIntArray>(data, "second_fiber");

    for (std::size_t i = begin; i < end; ++i)
      {
        const ContactElement    &contact = contacts[i];
        std::array<vtkIdType, 2> ends;
        for (unsigned int s = 0; s < 2; ++s)
          ends[s] = points->InsertNextPoint(
            particle_position(mesh, q, contact, s).data());
        grid->InsertNextCell(VTK_LINE, 2, ends.data());

        gap->InsertNextValue(contact.gap);
        append_vector(normal, contact.normal_force * contact.normal);
        append_vector(friction, contact.friction_force);
        status->InsertNextValue(static_cast<int>(contact.status));
        zone->InsertNextValue(contact.zone);
        first->InsertNextValue(contact.fibers[0] % n_fibers);
        second->InsertNextValue(contact.fibers[1] % n_fibers);
      }
    return grid;
  }
} // namespace fiberloom
