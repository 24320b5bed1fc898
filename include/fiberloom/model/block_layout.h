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
   * in turn. Section 7 of the theory.
   */
  class BlockLayout
  {
  public:
    /**
     * @p matrix_nodes : stress-free positions [mm], three components each;
     * empty where there is no matrix. Every rank of @p communicator gives the
     * same.
     */
    BlockLayout(const FiberMesh       &mesh,
                const Eigen::VectorXd &matrix_nodes,
                const unsigned int     n_bodies,
                const MPI_Comm         communicator);

    /**
     * The blocks and owners of @p other , but with the numbers of dofs that
     * @p sizes has for each block.
     */
    BlockLayout(const BlockLayout               &other,
                const std::vector<unsigned int> &sizes);

    /** Number of blocks on all ranks: nodes and bodies. */
    unsigned int
    n_blocks() const
    {
      return first_dofs.size() - 1;
    }

    /**
     * Number of nodes of fibers and matrix together, whose blocks come first.
     */
    unsigned int
    n_nodes() const
    {
      return n_all_nodes;
    }

    /** Number of dofs on all ranks. */
    unsigned int
    n_dofs() const
    {
      return first_dofs.back();
    }

    /** Number of the first dof of @p block ; the others follow it. */
    unsigned int
    first_dof(const unsigned int block) const
    {
      return first_dofs[block];
    }

    /**
     * Number of dofs of @p block : 9 for a fiber node, 3 for a node of the
     * matrix, 6 for a body, unless other sizes were given.
     */
    unsigned int
    size(const unsigned int block) const
    {
      return first_dofs[block + 1] - first_dofs[block];
    }

    /** Whether @p block is a node of the matrix, told by its three dofs. */
    bool
    is_matrix_node(const unsigned int block) const
    {
      return size(block) == 3;
    }

    /** The block of body number @p body : all bodies come after the nodes. */
    unsigned int
    body_block(const unsigned int body) const
    {
      return n_all_nodes + body;
    }

    /** The rank that owns @p block . */
    unsigned int
    owner(const unsigned int block) const
    {
      return owners[block];
    }

    /**
     * Index of @p block among the owned blocks; -1 where another rank owns it.
     */
    int
    local_block(const unsigned int block) const
    {
      return local_blocks[block];
    }

    /** The blocks that this rank owns, sorted. */
    const std::vector<unsigned int> &
    owned_blocks() const
    {
      return owned;
    }

    /**
     * Where the owned block number @p local_block begins in the owned part of a
     * distributed vector.
     */
    unsigned int
    local_first_dof(const unsigned int local_block) const
    {
      return local_first_dofs[local_block];
    }

    /** Number of dofs that this rank owns. */
    unsigned int
    n_owned_dofs() const
    {
      return n_own_dofs;
    }

    /** Numbers of the owned dofs among those of all ranks. */
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
