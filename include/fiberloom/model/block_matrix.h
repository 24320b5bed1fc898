// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_model_block_matrix_h
#define fiberloom_model_block_matrix_h

#include <fiberloom/model/block_layout.h>

#include <Eigen/Core>

#include <Epetra_Import.h>
#include <Epetra_Map.h>
#include <Epetra_Operator.h>
#include <mpi.h>

#include <array>
#include <memory>
#include <vector>

namespace fiberloom
{
  /**
   * A sparse matrix of dense blocks, of which each rank holds the rows of the
   * blocks it owns: a Trilinos operator for Krylov methods whose entries are
   * written without a search for single columns. The pattern is symmetric.
   */
  class BlockMatrix : public Epetra_Operator
  {
  public:
    /** Rotations of bodies count as displacements at @p lever [mm]; the matrix
     * around the fibers is as stiff as @p matrix_weight times these. */
    BlockMatrix(const BlockLayout &layout,
                const double       lever,
                const double       matrix_weight = 1);

    /**
     * Sets the pattern: @p columns has, for each owned block, the sorted
     * blocks it is coupled to, itself included. Values become zero. A pattern
     * that holds all of these and hardly more is kept as it is.
     */
    void
    reinit(std::vector<std::vector<unsigned int>> columns);

    void
    set_zero();

    /** Leaves of blocks that are not @p kept only @p diagonal . */
    void
    isolate(const std::vector<char> &kept, const double diagonal);

    /** Adds @p value to the diagonal entries of fibers and of displacements,
     * times the lever squared to those of rotations, times its weight to those
     * of the matrix. */
    void
    add_to_diagonal(const double value);

    /** Its product with the owned part of a vector. */
    std::vector<double>
    times(const std::vector<double> &x) const;

    /** Adds @p values , one for each fiber node, to the diagonal entries of its
     * block. */
    void
    add_to_diagonal(const std::vector<double> &values);

    /** The least of what the first of them has added to displacements since all
     * was zero. */
    double
    least_addition() const;

    /**
     * Adds row * column^T, given on @p blocks , to products, and to nothing
     * else: what makes the matrix unsymmetric is no part of its factor. All
     * blocks are coupled to the owned ones among them in the pattern.
     */
    void
    add_outer_product(const std::vector<unsigned int> &blocks,
                      const Eigen::VectorXd           &row,
                      const Eigen::VectorXd           &column);

    void
    remove_outer_products();

    /** From here on products have these parts. */
    void
    use_outer_products()
    {
      outer_products_used = true;
    }

    /** From here on they do not, as at first. */
    void
    leave_out_outer_products()
    {
      outer_products_used = false;
    }

    /** Where the block (row, column) is stored, row by row; the row is owned.
     */
    double *
    block(const unsigned int row, const unsigned int column);

    const double *
    block(const unsigned int row, const unsigned int column) const;

    const BlockLayout &
    layout() const
    {
      return numbering;
    }

    /** Blocks coupled to the owned block number @p local_row . */
    const std::vector<unsigned int> &
    columns(const unsigned int local_row) const
    {
      return column_blocks[local_row];
    }

    const double *
    values(const unsigned int local_row, const unsigned int index) const
    {
      return data.data() + offsets[local_row][index];
    }

    double *
    values(const unsigned int local_row, const unsigned int index)
    {
      return data.data() + offsets[local_row][index];
    }

    /** Number of patterns so far. */
    unsigned int
    pattern_version() const
    {
      return version;
    }

    /** Values that a product needs from other ranks, summed over all of them.
     * Collective. */
    std::size_t
    n_exchanged() const;

    int
    Apply(const Epetra_MultiVector &x, Epetra_MultiVector &y) const override;

    int
    ApplyInverse(const Epetra_MultiVector &,
                 Epetra_MultiVector &) const override
    {
      return -1;
    }

    int
    SetUseTranspose(bool) override
    {
      return 0; // symmetric
    }

    double
    NormInf() const override
    {
      return 0;
    }

    const char *
    Label() const override
    {
      return "block matrix";
    }

    bool
    UseTranspose() const override
    {
      return false;
    }

    bool
    HasNormInf() const override
    {
      return false;
    }

    const Epetra_Comm &
    Comm() const override
    {
      return owned_map.Comm();
    }

    const Epetra_Map &
    OperatorDomainMap() const override
    {
      return owned_map;
    }

    const Epetra_Map &
    OperatorRangeMap() const override
    {
      return owned_map;
    }

  private:
    /** Of a product with the vector @p in of all columns, into @p out . */
    template <int height>
    void
    multiply_row(const unsigned int row, const double *in, double *out) const;

    /** Whether the pattern holds @p columns on every rank, and hardly more. */
    bool
    covers(const std::vector<std::vector<unsigned int>> &columns) const;

    struct OuterProduct
    {
      std::vector<std::array<unsigned int, 3>>
        rows; // owned: where in the result, where in the vector, size
      std::vector<std::array<unsigned int, 3>> columns; // the same, imported
      Eigen::VectorXd                          row, column;
    };

    const BlockLayout &numbering;
    const double       lever, matrix_weight;
    double             added = 0; // to the diagonal
    Epetra_Map         owned_map;
    unsigned int       version = 0;

    std::vector<std::vector<unsigned int>> column_blocks;
    std::vector<std::vector<std::size_t>>  offsets;
    std::vector<double>                    data;

    // Of each column block, the position in the imported vector.
    std::unique_ptr<Epetra_Map>            column_map;
    std::unique_ptr<Epetra_Import>         importer;
    std::vector<std::vector<unsigned int>> column_positions;
    std::vector<unsigned int>              position_of_block;

    std::vector<OuterProduct> outer_products;
    bool                      outer_products_used = false;
  };
} // namespace fiberloom

#endif
