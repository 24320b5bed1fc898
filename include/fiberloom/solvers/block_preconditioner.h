// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_solvers_block_preconditioner_h
#define fiberloom_solvers_block_preconditioner_h

#include <fiberloom/solvers/direct_factor.h>
#include <fiberloom/solvers/preconditioner.h>

namespace fiberloom
{
  /**
   * Block Gauss-Seidel of a composite as a preconditioner of Trilinos: fibers
   * with bodies first, then, with what these leave of the residual, the matrix,
   * each by a factor of its own. The stiffer the junctions, the worse.
   */
  class BlockPreconditioner : public Preconditioner
  {
  public:
    BlockPreconditioner(const MPI_Comm                comm,
                        const DirectFactor::Precision precision);

    /**
     * Analyses both blocks of @p matrix , see DirectFactor::analyse(). Throws
     * StageFailure.
     */
    void
    analyse(const BlockMatrix &matrix);

    /** Forgets earlier matrices, see DirectFactor::forget(). */
    void
    forget();

    /**
     * Factorises both blocks of @p matrix , which is kept by reference. Returns
     * the number of negative pivots or -1, as DirectFactor::factorize().
     */
    int
    factorize(const BlockMatrix &matrix);

    int
    ApplyInverse(const Epetra_MultiVector &x,
                 Epetra_MultiVector       &y) const override;

  private:
    mutable DirectFactor fibers, hexes;
  };
} // namespace fiberloom

#endif
