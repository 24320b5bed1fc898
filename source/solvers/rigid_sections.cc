// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/solvers/rigid_sections.h>

#include <cmath>

namespace fiberloom
{
  namespace
  {
    constexpr unsigned int n_motions = 6;

    std::vector<unsigned int>
    reduced_sizes(const System &system)
    {
      const BlockLayout        &layout = system.layout();
      std::vector<unsigned int> sizes;
      for (unsigned int block = 0; block < layout.n_blocks(); ++block)
        sizes.push_back(layout.size(block) == 9 &&
                            system.motion().attachment(block) < 0 ?
                          n_motions :
                          layout.size(block));
      return sizes;
    }
  } // namespace



  RigidSections::RigidSections(const System &system)
    : full(system.layout())
    , reduced(system.layout(), reduced_sizes(system))
  {}



  void
  RigidSections::follow(const Eigen::VectorXd &q)
  {
    const unsigned int n_nodes = q.size() / 9;
    motion_basis.assign(n_nodes, Motions::Zero());
    strain_basis.assign(n_nodes, Strains::Zero());
    for (unsigned int node = 0; node < n_nodes; ++node)
      {
        // Sections deform little, so that a frame near their vectors is enough.
        const Vector3 g1     = q.segment<3>(9 * node + 3).normalized();
        const Vector3 g2     = q.segment<3>(9 * node + 6).normalized();
        const Vector3 normal = g1.cross(g2).normalized();
        const Vector3 middle = (g1 + g2).normalized();
        const Vector3 across = normal.cross(middle);
        const Vector3 t1     = (middle - across) * M_SQRT1_2;
        const Vector3 t2     = (middle + across) * M_SQRT1_2;

        auto &motions                 = motion_basis[node];
        motions.topLeftCorner<3, 3>() = Matrix3::Identity();
        motions.block<3, 1>(3, 3)     = normal;
        motions.block<3, 1>(6, 4)     = normal;
        motions.block<3, 1>(3, 5)     = t2 * M_SQRT1_2;
        motions.block<3, 1>(6, 5)     = -t1 * M_SQRT1_2;
        auto &strains                 = strain_basis[node];
        strains.block<3, 1>(3, 0)     = t1;
        strains.block<3, 1>(6, 1)     = t2;
        strains.block<3, 1>(3, 2)     = t2 * M_SQRT1_2;
        strains.block<3, 1>(6, 2)     = t1 * M_SQRT1_2;
      }
  }



  const double *
  RigidSections::reduce(const unsigned int row,
                        const unsigned int column,
                        const double      *values) const
  {
    using Eigen::Dynamic;
    // At most nine rows and columns, so that nothing is allocated. Products as
    // small as these are slower by the kernels for large matrices.
    using Any  = Eigen::Matrix<double, Dynamic, Dynamic, Eigen::RowMajor, 9, 9>;
    using Both = Eigen::Matrix<double, n_motions, n_motions, Eigen::RowMajor>;

    const bool rows = is_split(row), columns = is_split(column);
    if (rows && columns)
      {
        const Eigen::Matrix<double, 9, n_motions> right =
          Eigen::Map<const Stiffness>(values).lazyProduct(motion_basis[column]);
        Eigen::Map<Both>(reduced_block.data()).noalias() =
          motion_basis[row].transpose().lazyProduct(right);
        return reduced_block.data();
      }
    if (!rows && !columns)
      return values;
    const Eigen::Map<const Any> all(values, full.size(row), full.size(column));
    Eigen::Map<Any>             part(reduced_block.data(),
                         reduced.size(row),
                         reduced.size(column));
    if (rows)
      part = motion_basis[row].transpose() * all;
    else
      part = all * motion_basis[column];
    return reduced_block.data();
  }
} // namespace fiberloom
