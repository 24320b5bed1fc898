// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_solvers_block_preconditioner_h
#define fiberloom_solvers_block_preconditioner_h

#include <fiberloom/solvers/direct_factor.h>

#include <Epetra_Operator.h>

namespace fiberloom
{
  /**
   * Block Gauss-Seidel of a composite as a preconditioner of Trilinos: fibers
   * with bodies first, then, with what these leave of the residual, the matrix,
   * each by a factor of its own. The stiffer the junctions, the worse.
   */
  class BlockPreconditioner : public Epetra_Operator
  {
  public:
    BlockPreconditioner(const MPI_Comm                comm,
                        const DirectFactor::Precision precision);

    void
    analyse(const BlockMatrix &matrix);

    /** As DirectFactor::factorize(), of both; keeps a reference. */
    int
    factorize(const BlockMatrix &matrix);

    int
    ApplyInverse(const Epetra_MultiVector &x,
                 Epetra_MultiVector       &y) const override;

    int
    Apply(const Epetra_MultiVector &, Epetra_MultiVector &) const override
    {
      return -1;
    }

    int
    SetUseTranspose(bool) override
    {
      return -1;
    }

    double
    NormInf() const override
    {
      return 0;
    }

    const char *
    Label() const override
    {
      return "blocks";
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
      return matrix->Comm();
    }

    const Epetra_Map &
    OperatorDomainMap() const override
    {
      return matrix->OperatorDomainMap();
    }

    const Epetra_Map &
    OperatorRangeMap() const override
    {
      return matrix->OperatorRangeMap();
    }

  private:
    mutable DirectFactor fibers, hexes;
    const BlockMatrix   *matrix = nullptr;
  };
} // namespace fiberloom

#endif
