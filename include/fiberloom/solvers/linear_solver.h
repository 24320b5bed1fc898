// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_solvers_linear_solver_h
#define fiberloom_solvers_linear_solver_h

#include <fiberloom/solvers/direct_factor.h>

#include <string>
#include <vector>

namespace fiberloom
{
  /**
   * Solves the system of a Newton iteration by a Krylov method of Trilinos in
   * double precision around a MUMPS factor of the symmetric part in single or
   * double precision. Only moments on free bodies make it unsymmetric. An
   * indefinite matrix gets a diagonal shift that grows until it is not, so that
   * the solution is a direction of descent.
   */
  class LinearSolver
  {
  public:
    /** @p precision : automatic, single or double. */
    LinearSolver(const BlockLayout &layout, const std::string &precision);

    struct Outcome
    {
      unsigned int iterations      = 0;
      unsigned int factorizations  = 0;
      double       shift           = 0;
      int          negative_pivots = 0; // without shift; -1: it failed
      double       analysis        = 0; // [s], as the next two
      double       factorization   = 0;
      double       krylov          = 0;
    };

    /**
     * @p solution : the owned part, resized. @p damping is added to the
     * diagonal of @p matrix in any case, @p shift_unit is the smallest shift
     * to be tried where that is indefinite [N/mm] unless it may be. Throws
     * StageFailure if no shift helps.
     */
    Outcome
    solve(BlockMatrix               &matrix,
          const std::vector<double> &right_hand_side,
          const double               damping,
          const double               shift_unit,
          std::vector<double>       &solution,
          const bool                 may_be_indefinite = false);

    /** Seconds of one factorisation of @p matrix in double precision. */
    static double
    time_double_factorization(const BlockMatrix &matrix);

  private:
    DirectFactor factor;
  };
} // namespace fiberloom

#endif
