// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_solvers_preconditioner_h
#define fiberloom_solvers_preconditioner_h

#include <fiberloom/model/block_matrix.h>

#include <Epetra_Operator.h>

namespace fiberloom
{
  /** An approximate inverse of a BlockMatrix as Trilinos wants it: of an
   * Epetra_Operator only ApplyInverse() is left to define. */
  class Preconditioner : public Epetra_Operator
  {
  public:
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
      return "preconditioner";
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

  protected:
    const BlockMatrix *matrix = nullptr; // to be set before use
  };
} // namespace fiberloom

#endif
