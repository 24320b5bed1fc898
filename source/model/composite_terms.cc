// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/model/composite_terms.h>
#include <fiberloom/model/element_groups.h>

#include <algorithm>

namespace fiberloom
{
  namespace
  {
    double
    largest_place(const Composite &composite)
    {
      return composite.matrix().reference().lpNorm<Eigen::Infinity>();
    }
  } // namespace



  void
  CellTerm::visit_couplings(const CouplingVisitor &couple) const
  {
    for (unsigned int c = 0; c < composite.matrix().n_cells(); ++c)
      {
        auto blocks = nodes_of_cell(composite, c);
        couple(blocks);
      }
  }



  void
  CellTerm::add(const State &state, Assembly &sum) const
  {
    const MatrixMesh     &matrix    = composite.matrix();
    const Eigen::VectorXd positions = composite.positions(state.q);
    MixedGroup            group;
    for (unsigned int c = 0; c < matrix.n_cells(); ++c)
      {
        group.set_nodes(nodes_of_cell(composite, c), layout);
        if (!sum.touches_owned(group.nodes.data(),
                               group.nodes.size(),
                               composite.originals()))
          continue;
        const Eigen::VectorXd x = matrix.cell_positions(positions, c);
        if (sum.with_tangent())
          matrix.element(c).residual_and_tangent(x,
                                                 group.residual,
                                                 group.tangent);
        else
          group.residual = matrix.element(c).residual(x);
        sum.note_force(group.residual.lpNorm<Eigen::Infinity>());
        sum.scatter(group, composite.originals());
      }
  }



  double
  CellTerm::energy(const State &state) const
  {
    const MatrixMesh     &matrix    = composite.matrix();
    const Eigen::VectorXd positions = composite.positions(state.q);
    double                energy    = 0;
    for (unsigned int c = 0; c < matrix.n_cells(); ++c)
      if (owns(composite.first_node() + matrix.nodes(c).front()))
        energy += matrix.element(c).energy(matrix.cell_positions(positions, c));
    return energy;
  }



  double
  CellTerm::rounding() const
  {
    const MatrixMesh &matrix = composite.matrix();
    const double modulus = matrix.law().stiffness(Matrix3::Identity())(0, 0);
    return rounding_errors * modulus * largest_place(composite) *
           matrix.largest_slope();
  }



  void
  JunctionTerm::visit_couplings(const CouplingVisitor &couple) const
  {
    for (const JunctionElement &junction : composite.junctions())
      {
        auto blocks = nodes_of_junction(composite, junction);
        couple(blocks);
      }
  }



  void
  JunctionTerm::add(const State &state, Assembly &sum) const
  {
    for (unsigned int j = 0; j < composite.junctions().size(); ++j)
      {
        const JunctionGroup group(composite, j, state.q, layout);
        if (!sum.touches_owned(group.nodes.data(),
                               group.nodes.size(),
                               composite.originals()))
          continue;
        if (sum.is_held(group.nodes, composite.originals()))
          sum.scatter(group, composite.originals());
        else
          scatter_diagonals(group, sum);
      }
  }



  void
  JunctionTerm::scatter_diagonals(const JunctionGroup &group, Assembly &sum)
  {
    for (unsigned int a = 0; a < group.nodes.size(); ++a)
      {
        const unsigned int row   = group.nodes[a];
        const int          local = sum.layout.local_block(row);
        if (local < 0)
          continue;
        double *forces = sum.forces(local);
        for (unsigned int i = 0; i < group.size(a); ++i)
          forces[i] += group.weight(a, i / 3) * -group.fiber_force[i % 3];
        if (!sum.with_tangent())
          continue;
        for (unsigned int b = 0; b < group.nodes.size(); ++b)
          {
            double *entries          = sum.matrix().block(row, group.nodes[b]);
            const unsigned int width = group.size(b);
            for (unsigned int i = 0; i < group.size(a); ++i)
              for (unsigned int v = 0; v < width / 3; ++v)
                entries[i * width + 3 * v + i % 3] +=
                  group.stiffness_of(a, i / 3, b, v);
          }
      }
  }



  double
  JunctionTerm::energy(const State &state) const
  {
    const Eigen::VectorXd positions = composite.positions(state.q);
    double                energy    = 0;
    for (const JunctionElement &junction : composite.junctions())
      if (owns(junction.fiber_nodes()[0]))
        energy += junction.energy(state.q, positions);
    return energy;
  }



  double
  JunctionTerm::rounding() const
  {
    double stiffest = 0;
    for (const JunctionElement &junction : composite.junctions())
      stiffest = std::max(stiffest, junction.spring());
    return rounding_errors * stiffest * largest_place(composite);
  }
} // namespace fiberloom
