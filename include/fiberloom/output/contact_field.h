// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_contact_field_h
#define fiberloom_output_contact_field_h

#include <fiberloom/contact/contact_element.h>

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <vector>

namespace fiberloom
{
  /** Where the particle of side @p s of a contact element is [mm]. */
  Vector3
  particle_position(const FiberMesh      &mesh,
                    const DofVector      &q,
                    const ContactElement &contact,
                    const unsigned int    s);

  /**
   * The contact elements @p begin to @p end as lines between their two
   * particles. Cell data: gap [mm], normal_force and friction_force on the
   * first fiber (vectors, [N]), status (0 open, 1 stick, 2 slip), zone,
   * first_fiber, second_fiber.
   */
  vtkSmartPointer<vtkUnstructuredGrid>
  contact_field(const FiberMesh                   &mesh,
                const DofVector                   &q,
                const std::vector<ContactElement> &contacts,
                const std::size_t                  begin,
                const std::size_t                  end);
} // namespace fiberloom

#endif
