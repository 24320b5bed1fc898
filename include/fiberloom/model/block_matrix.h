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
   *
   * Its entries are derivatives of forces by increments of the unknowns: [N/mm]
   * between displacements, [N] between a displacement and a rotation of a body,
   * [N mm] between two rotations. Section 7 of the theory.
   */
  class BlockMatrix : public Epetra_Operator
  {
  public:
    /**
     * Rotations of bodies count as displacements at @p lever [mm]; the matrix
     * around the fibers is as stiff as @p matrix_weight times these. @p layout
     * is kept by reference. There is no pattern before reinit().
     */
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

    /**
     * Sets all blocks to zero and forgets what add_to_diagonal() has added. The
     * pattern and the outer products stay.
     */
    void
    set_zero();

    /**
     * Uncouples the blocks that are not @p kept : their rows and columns become
     * zero, with @p diagonal [N/mm] on the diagonal. @p kept has one entry for
     * each block of the layout.
     */
    void
    isolate(const std::vector<char> &kept, const double diagonal);

    /**
     * Adds @p value [N/mm] to the diagonal entries of fibers and of
     * displacements, times the lever squared to those of rotations, times the
     * matrix's weight to those of the matrix.
     */
    void
    add_to_diagonal(const double value);

    /**
     * The product with @p x ; argument and result are the owned parts of the
     * vectors, BlockLayout::n_owned_dofs() entries each. Collective.
     */
    std::vector<double>
    times(const std::vector<double> &x) const;

    /**
     * Adds @p values [N/mm], one for each fiber node, to the nine diagonal
     * entries of its block. least_addition() does not count these.
     */
    void
    add_to_diagonal(const std::vector<double> &values);

    /**
     * The least sum that add_to_diagonal() with a single value has added to any
     * displacement since all was zero [N/mm].
     */
    double
    least_addition() const;

    /**
     * Adds row * column^T to products, and to nothing else: what makes the
     * matrix unsymmetric is no part of its factor. @p row and @p column hold
     * the dofs of @p blocks , one block after the other. All blocks are coupled
     * to the owned ones among them in the pattern.
     */
    void
    add_outer_product(const std::vector<unsigned int> &blocks,
                      const Eigen::VectorXd           &row,
                      const Eigen::VectorXd           &column);

    /** Forgets all outer products that were added. */
    void
    remove_outer_products();

    /** From here on products include the outer products. */
    void
    use_outer_products()
    {
      outer_products_used = true;
    }

    /** From here on products do not include the outer products, as at first. */
    void
    leave_out_outer_products()
    {
      outer_products_used = false;
    }

    /**
     * The block ( @p row , @p column ), stored row by row: layout().size(
     * @p row ) times layout().size( @p column ) entries. @p row is owned, and
     * the pattern holds @p column ; debug builds check that.
     */
    double *
    block(const unsigned int row, const unsigned int column);

    /** The same for reading. */
    const double *
    block(const unsigned int row, const unsigned int column) const;

    /** Numbering and ownership of rows and columns. */
    const BlockLayout &
    layout() const
    {
      return numbering;
    }

    /**
     * Sorted numbers of the blocks coupled to the owned block number
     * @p local_row , itself included.
     */
    const std::vector<unsigned int> &
    columns(const unsigned int local_row) const
    {
      return column_blocks[local_row];
    }

    /**
     * The block in the owned row @p local_row and in the column columns(
     * @p local_row )[ @p index ], stored row by row as in block().
     */
    const double *
    values(const unsigned int local_row, const unsigned int index) const
    {
      return data.data() + offsets[local_row][index];
    }

    /** The same for writing. */
    double *
    values(const unsigned int local_row, const unsigned int index)
    {
      return data.data() + offsets[local_row][index];
    }

    /**
     * Number of patterns that reinit() has set so far; one that it has kept
     * does not count.
     */
    unsigned int
    pattern_version() const
    {
      return version;
    }

    /**
     * Number of values that a product needs from other ranks, summed over all
     * of them. Collective.
     */
    std::size_t
    n_exchanged() const;

    /**
     * Multiplies @p x by the matrix into @p y , for vectors distributed by
     * OperatorDomainMap(). Returns the error code of Trilinos, 0 if there is
     * none. Collective.
     */
    int
    Apply(const Epetra_MultiVector &x, Epetra_MultiVector &y) const override;

    /** There is no inverse here: returns -1. */
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
    /**
     * Multiplies the owned row number @p row by @p in , which holds the dofs of
     * all columns, and writes the result to @p out . @p height is the number of
     * dofs of that row, or Eigen::Dynamic.
     */
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
