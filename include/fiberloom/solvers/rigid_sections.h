// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_solvers_rigid_sections_h
#define fiberloom_solvers_rigid_sections_h

#include <fiberloom/model/system.h>

#include <array>
#include <vector>

namespace fiberloom
{
  /**
   * Splits the nine dofs of a fiber node into the six motions of a rigid
   * section and three strains in its plane. Strains are stiff and hardly couple
   * one section to the next, so a system of the motions alone, with two thirds
   * of the dofs, holds nearly all that makes systems of fibers hard to solve.
   * Nodes held by a body keep their dofs, as do bodies and the matrix. Section
   * 8 of the theory.
   */
  class RigidSections
  {
  public:
    using Motions   = Eigen::Matrix<double, 9, 6>; // orthonormal columns
    using Strains   = Eigen::Matrix<double, 9, 3>;
    using Stiffness = Eigen::Matrix<double, 9, 9, Eigen::RowMajor>;

    explicit RigidSections(const System &system);

    /**
     * Makes the bases those of sections that are where @p q has them, nine
     * components a fiber node.
     */
    void
    follow(const Eigen::VectorXd &q);

    /**
     * The layout of the motions: six dofs in the block of a node that is split.
     */
    const BlockLayout &
    layout() const
    {
      return reduced;
    }

    /**
     * Whether @p block is a fiber node that is split into motions and strains.
     */
    bool
    is_split(const unsigned int block) const
    {
      return reduced.size(block) < full.size(block);
    }

    /** The basis of the six motions of a node that is split, 9 x 6. */
    const Motions &
    motions(const unsigned int block) const
    {
      return motion_basis[block];
    }

    /** The basis of its three strains, 9 x 3. */
    const Strains &
    strains(const unsigned int block) const
    {
      return strain_basis[block];
    }

    /**
     * The part of the block ( @p row , @p column ) that is of motions, row by
     * row; @p values is the whole block, stored in the same way. Valid until
     * the next call.
     */
    const double *
    reduce(const unsigned int row,
           const unsigned int column,
           const double      *values) const;

  private:
    const BlockLayout             &full;
    BlockLayout                    reduced;
    std::vector<Motions>           motion_basis;
    std::vector<Strains>           strain_basis;
    mutable std::array<double, 81> reduced_block;
  };
} // namespace fiberloom

#endif
