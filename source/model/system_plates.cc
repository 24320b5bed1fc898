// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/model/plate_group.h>
#include <fiberloom/model/scatter.h>

namespace fiberloom
{
  template <class Visitor>
  void
  System::visit_plate_stations(const State &state, const Visitor &visit) const
  {
    const Plates &plates = *supports.plates;
    const Vector3 place  = state.placements[plates.body].position;
    for (unsigned int e = 0; e < mesh.n_elements(); ++e)
      {
        const auto        &line = mesh.lines()[mesh.fiber_of_element(e)];
        const unsigned int node = mesh.first_node(e);
        PlateGroup         group;
        group.nodes = {
          {node, node + 1, node + 2, numbering.body_block(plates.body)}};
        for (unsigned int k = 0; k < plates.stations_per_element; ++k)
          {
            group.weights =
              shape_values((2 * k + 1.) / plates.stations_per_element - 1);
            PlateContact::Heights x;
            x << 0, 0, 0, place.x(), place.z();
            for (unsigned int a = 0; a < 3; ++a)
              for (unsigned int v = 0; v < 3; ++v)
                x[v] += group.weights[a] * state.q[9 * (node + a) + 3 * v + 2];
            for (const bool upper : {false, true})
              {
                const PlateContact contact{plates.stiffness *
                                             line.young_modulus * line.length /
                                             (line.n_elements *
                                              plates.stations_per_element),
                                           plates.regularization * line.radius,
                                           upper};
                visit(contact, x, group);
              }
          }
      }
  }



  template <bool with_tangent>
  void
  System::add_plates(const State &state)
  {
    const Plates &plates = *supports.plates;
    visit_plate_stations(
      state,
      [&](const PlateContact          &contact,
          const PlateContact::Heights &x,
          PlateGroup                  &group) {
        if (!touches_owned(group.nodes.data(), 4, mesh.originals()) ||
            !contact.evaluate(x,
                              group.gradient,
                              with_tangent ? &group.hessian : nullptr))
          return;
        scatter<with_tangent>(state, group, mesh.originals());
      });
    const unsigned int block = numbering.body_block(plates.body);
    const int          local = numbering.local_block(block);
    if (local < 0)
      return;
    const double spring = plates.spring * stiffness;
    residual[numbering.local_first_dof(local) + 2] +=
      spring * state.placements[plates.body].position.z();
    if constexpr (with_tangent)
      system_matrix.block(block, block)[6 * 2 + 2] += spring;
  }



  double
  System::plate_energy(const State &state) const
  {
    double energy = 0;
    visit_plate_stations(state,
                         [&](const PlateContact          &contact,
                             const PlateContact::Heights &x,
                             const PlateGroup            &group) {
                           if (numbering.local_block(group.nodes[0]) >= 0)
                             energy += contact.energy(x);
                         });
    const Plates &plates = *supports.plates;
    const double  middle = state.placements[plates.body].position.z();
    if (numbering.local_block(numbering.body_block(plates.body)) >= 0)
      energy += .5 * plates.spring * stiffness * middle * middle;
    return energy;
  }



  template void
  System::add_plates<true>(const State &state);
  template void
  System::add_plates<false>(const State &state);
} // namespace fiberloom
