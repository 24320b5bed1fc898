// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_model_block_layout_h
#define fiberloom_model_block_layout_h

#include <fiberloom/beams/fiber_mesh.h>

#include <mpi.h>

#include <vector>

namespace dealii
{
  class IndexSet;
}

namespace fiberloom
{
  /**
   * Numbering and ownership of the unknowns. They come in blocks that belong
   * together: nine for a fiber node, three for a node of the matrix, six for a
   * rigid body; fiber nodes first, bodies last. So the dofs of nodes are
   * numbered as those of a State are. Nodes are dealt to the ranks in equal
   * numbers along a space-filling curve through the initial placement, bodies
   * in turn.
   */
  class BlockLayout
  {
  public:
    /** @p matrix_nodes : stress-free positions, three components each; empty
     * where there is no matrix. */
    BlockLayout(const FiberMesh       &mesh,
                const Eigen::VectorXd &matrix_nodes,
                const unsigned int     n_bodies,
                const MPI_Comm         communicator);

    /** As @p other , with blocks of these sizes. */
    BlockLayout(const BlockLayout               &other,
                const std::vector<unsigned int> &sizes);

    unsigned int
    n_blocks() const
    {
      return first_dofs.size() - 1;
    }

    /** Of fibers and matrix. */
    unsigned int
    n_nodes() const
    {
      return n_all_nodes;
    }

    unsigned int
    n_dofs() const
    {
      return first_dofs.back();
    }

    unsigned int
    first_dof(const unsigned int block) const
    {
      return first_dofs[block];
    }

    unsigned int
    size(const unsigned int block) const
    {
      return first_dofs[block + 1] - first_dofs[block];
    }

    /** Whether it is a node of the matrix. */
    bool
    is_matrix_node(const unsigned int block) const
    {
      return size(block) == 3;
    }

    unsigned int
    body_block(const unsigned int body) const
    {
      return n_all_nodes + body;
    }

    unsigned int
    owner(const unsigned int block) const
    {
      return owners[block];
    }

    /** Rank among the owned blocks, or -1. */
    int
    local_block(const unsigned int block) const
    {
      return local_blocks[block];
    }

    const std::vector<unsigned int> &
    owned_blocks() const
    {
      return owned;
    }

    /** Of an owned block in the rank's part of a distributed vector. */
    unsigned int
    local_first_dof(const unsigned int local_block) const
    {
      return local_first_dofs[local_block];
    }

    unsigned int
    n_owned_dofs() const
    {
      return n_own_dofs;
    }

    dealii::IndexSet
    owned_dofs() const;

    MPI_Comm
    communicator() const
    {
      return comm;
    }

  private:
    /** Sets all that follows from sizes and owners. */
    void
    number(const std::vector<unsigned int> &sizes);

    MPI_Comm                  comm;
    unsigned int              n_all_nodes;
    std::vector<unsigned int> first_dofs, owners, owned, local_first_dofs;
    std::vector<int>          local_blocks;
    unsigned int              n_own_dofs = 0;
  };
} // namespace fiberloom

#endif
