// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_solvers_multigrid_h
#define fiberloom_solvers_multigrid_h

#include <fiberloom/model/system.h>

#include <memory>
#include <vector>

class Epetra_CrsMatrix;

namespace ML_Epetra
{
  class MultiLevelPreconditioner;
}

namespace fiberloom
{
  /**
   * Smoothed aggregation by Trilinos's ML: a preconditioner for systems whose
   * factor does not fit into memory. What the coarse levels have to represent,
   * the motions that store no energy, is given as @p modes .
   */
  class Multigrid
  {
  public:
    explicit Multigrid(const RigidModes &modes);
    ~Multigrid();

    /** Coarsens @p matrix . */
    void
    build(const BlockMatrix &matrix);

    /** Valid until the next build(). */
    Epetra_Operator &
    preconditioner();

  private:
    std::vector<double>                                  modes;
    std::unique_ptr<Epetra_CrsMatrix>                    copy;
    std::unique_ptr<ML_Epetra::MultiLevelPreconditioner> hierarchy;
  };
} // namespace fiberloom

#endif
