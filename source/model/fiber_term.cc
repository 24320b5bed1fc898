// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/model/element_groups.h>
#include <fiberloom/model/fiber_term.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace fiberloom
{
  namespace
  {
    constexpr double rounding_errors_of_sections =
      4 * std::numeric_limits<double>::epsilon();
  } // namespace



  void
  FiberTerm::visit_couplings(const CouplingVisitor &couple) const
  {
    std::vector<unsigned int> blocks;
    for (unsigned int e = 0; e < mesh.n_elements(); ++e)
      {
        const unsigned int n = mesh.first_node(e);
        blocks               = {n, n + 1, n + 2};
        couple(blocks);
      }
  }



  void
  FiberTerm::add(const State &state, Assembly &sum) const
  {
    ElementGroup group;
    for (unsigned int e = 0; e < mesh.n_elements(); ++e)
      {
        const unsigned int first = mesh.first_node(e);
        group.nodes              = {{first, first + 1, first + 2}};
        if (!sum.touches_owned(group.nodes.data(), 3, originals))
          continue;
        const auto q = mesh.element_dofs(state.q, e);
        mesh.visit_element(e, state.fibers, [&](const BeamElement &element) {
          if (sum.with_tangent())
            element.residual_and_tangent(q,
                                         group.residual,
                                         group.tangent,
                                         sum.curvature());
          else
            element.residual(q, group.residual);
        });
        sum.note_force(group.residual.lpNorm<Eigen::Infinity>());
        sum.scatter(group, originals);
      }
  }



  double
  FiberTerm::energy(const State &state) const
  {
    double energy = 0;
    for (unsigned int e = 0; e < mesh.n_elements(); ++e)
      if (owns(mesh.first_node(e)))
        energy +=
          mesh.visit_element(e, state.fibers, [&](const BeamElement &element) {
            return element.energy(mesh.element_dofs(state.q, e));
          });
    return energy;
  }



  double
  FiberTerm::rounding() const
  {
    const double size     = mesh.reference().lpNorm<Eigen::Infinity>();
    double       rounding = 0;
    for (const auto &line : mesh.lines())
      {
        const double axial_stiffness =
          line.young_modulus * M_PI * line.radius * line.radius;
        // Forces that widen and shear a section are those of an element's whole
        // length: in very slender fibers their rounding is larger.
        rounding = std::max({rounding,
                             rounding_errors * axial_stiffness * size *
                               line.n_nodes() / line.length,
                             rounding_errors_of_sections * axial_stiffness *
                               line.length / (line.n_elements * line.radius)});
      }
    return rounding;
  }
} // namespace fiberloom
