// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_solvers_section_preconditioner_h
#define fiberloom_solvers_section_preconditioner_h

#include <fiberloom/solvers/direct_factor.h>
#include <fiberloom/solvers/preconditioner.h>
#include <fiberloom/solvers/rigid_sections.h>

#include <Eigen/Core>

#include <vector>

namespace fiberloom
{
  /**
   * Block Gauss-Seidel of the motions of rigid sections, with bodies and
   * matrix, by a factor, then of the strains in the plane of each section by
   * itself: a preconditioner of Trilinos. On the same graph the factor takes
   * (6/9)^3 of the operations of a whole one.
   */
  class SectionPreconditioner : public Preconditioner
  {
  public:
    /** The reference is kept. */
    SectionPreconditioner(const System                 &system,
                          const DirectFactor::Precision precision);

    /**
     * Analyses @p matrix , see DirectFactor::analyse(), for sections that are
     * where @p q has them, nine components a fiber node. Throws StageFailure.
     */
    void
    analyse(const BlockMatrix &matrix, const Eigen::VectorXd &q);

    /** Forgets earlier matrices, see DirectFactor::forget(). */
    void
    forget();

    /**
     * Factorises motions and strains of @p matrix , which is kept by reference.
     * Returns the number of negative pivots of the motions and of sections
     * whose strains are not definite, or -1 where the factorisation failed;
     * @p dropped as in DirectFactor::factorize().
     */
    int
    factorize(const BlockMatrix &matrix, const double dropped);

    int
    ApplyInverse(const Epetra_MultiVector &x,
                 Epetra_MultiVector       &y) const override;

  private:
    RigidSections        sections;
    mutable DirectFactor factor;
    std::vector<Matrix3> compliances; // of the strains, by owned block
  };
} // namespace fiberloom

#endif
