// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/scoped_timer.h>

#include <fiberloom/solvers/linear_solver.h>

#include <AztecOO.h>

#include <algorithm>

namespace fiberloom
{
  namespace
  {
    // Below the first size the double factor costs next to nothing more. At
    // 55,000 dofs both take the same time, at 92,000 rigid sections two thirds.
    constexpr unsigned int single_precision_from = 20000,
                           rigid_sections_from   = 60000;

    constexpr int          krylov_space   = 60;
    constexpr unsigned int largest_cycles = 5, largest_section_cycles = 2;
    constexpr double       shift_growth   = 8;
    constexpr unsigned int largest_shifts = 12;

    // Corrections that leave more than this part of the residual are those of
    // another matrix: Krylov's method needs fewer.
    constexpr double largest_contraction = .01;

    // What low-rank blocks may leave out, over the least damping, so that they
    // hardly make a pivot negative.
    constexpr double dropped_over_damping = .25;

    // Beyond so many it may be rounding that makes pivots negative.
    constexpr unsigned int largest_single_shifts = 3;

    class FactorPreconditioner : public Preconditioner
    {
    public:
      FactorPreconditioner(DirectFactor &factor, const BlockMatrix &matrix)
        : factor(factor)
      {
        this->matrix = &matrix;
      }

      int
      ApplyInverse(const Epetra_MultiVector &x,
                   Epetra_MultiVector       &y) const override
      {
        y = x;
        for (int v = 0; v < y.NumVectors(); ++v)
          factor.solve(matrix->layout(), y[v]);
        return 0;
      }

    private:
      DirectFactor &factor;
    };
  } // namespace



  LinearSolver::LinearSolver(const System &system, const std::string &name)
    : system(system)
    , name(name)
    , multigrid(name == "multigrid" ?
                  std::make_unique<Multigrid>(system.rigid_modes()) :
                  nullptr)
  {
    use_preferred();
    if (name == "blocks")
      blocks =
        std::make_unique<BlockPreconditioner>(system.layout().communicator(),
                                              precision);
  }



  void
  LinearSolver::use_preferred()
  {
    const unsigned int n_dofs   = system.layout().n_dofs();
    const bool         is_small = n_dofs < single_precision_from;
    precision                   = name == "double factor" ||
                    (is_small && (name == "automatic" || name == "blocks")) ?
                                    DirectFactor::Precision::double_precision :
                                    DirectFactor::Precision::single_precision;
    if (name == "rigid sections" ||
        (n_dofs >= rigid_sections_from && name == "automatic"))
      sections = std::make_unique<SectionPreconditioner>(system, precision);
    else
      use(precision);
    gave_way = false;
  }



  namespace
  {
    /** Adds to @p outcome ; whether the true residual has become small. A
     * preconditioner that is exact but for rounding is tried by itself first.
     */
    bool
    iterate(BlockMatrix           &matrix,
            Epetra_Operator       &preconditioner,
            Epetra_Vector         &b,
            Epetra_Vector         &x,
            const double           relative_tolerance,
            LinearSolver::Outcome &outcome,
            const bool             is_exact = true,
            const unsigned int     cycles   = largest_cycles)
    {
      ScopedTimer timer(outcome.krylov);
      double      norm;
      b.Norm2(&norm);
      x.PutScalar(0);
      if (norm == 0)
        return true;

      // Around a factor of the same matrix one correction is mostly enough.
      Epetra_Vector residual(b), product(b.Map()), correction(b.Map());
      for (double before = norm, after = 0; is_exact; before = after)
        {
          preconditioner.ApplyInverse(residual, correction);
          matrix.Apply(correction, product);
          ++outcome.iterations;
          residual.Update(-1, product, 1);
          residual.Norm2(&after);
          if (!(after < before))
            break;
          x.Update(1, correction, 1);
          if (after <= relative_tolerance * norm)
            return true;
          if (after > largest_contraction * before)
            break;
        }

      AztecOO krylov;
      krylov.SetUserOperator(&matrix);
      krylov.SetLHS(&x);
      krylov.SetRHS(&b);
      krylov.SetPrecOperator(&preconditioner);
      krylov.SetAztecOption(AZ_solver, AZ_gmres);
      krylov.SetAztecOption(AZ_kspace, krylov_space);
      krylov.SetAztecOption(AZ_output, AZ_none);
      krylov.SetAztecOption(AZ_conv, AZ_rhs);
      // The method estimates its residual as if the preconditioner were
      // exactly linear; in single precision it is not, so the true one decides.
      for (unsigned int cycle = 0; cycle < cycles; ++cycle)
        {
          krylov.Iterate(krylov_space, relative_tolerance);
          outcome.iterations += krylov.NumIters();
          if (krylov.TrueResidual() <= relative_tolerance * norm)
            return true;
        }
      return false;
    }



    /** What @p factorize returns; adds to @p outcome . */
    template <typename Factorize>
    int
    timed(LinearSolver::Outcome &outcome, const Factorize &factorize)
    {
      ScopedTimer timer(outcome.factorization);
      ++outcome.factorizations;
      return factorize();
    }



    void
    shift_more(BlockMatrix           &matrix,
               const unsigned int     attempt,
               const double           unit,
               LinearSolver::Outcome &outcome)
    {
      if (attempt == largest_shifts)
        throw StageFailure("the tangent stays indefinite for every shift");
      const double larger = std::max(unit, shift_growth * outcome.shift);
      matrix.add_to_diagonal(larger - outcome.shift);
      outcome.shift = larger;
    }
  } // namespace



  LinearSolver::Outcome
  LinearSolver::solve(BlockMatrix               &matrix,
                      const Eigen::VectorXd     &q,
                      const std::vector<double> &right_hand_side,
                      const double               damping,
                      const double               shift_unit,
                      std::vector<double>       &solution,
                      const Indefinite           indefinite,
                      const double               tolerance)
  {
    Outcome outcome;
    if (gave_way && was_indefinite)
      {
        // The finer factor found the same: the coarser one was right.
        factor.reset();
        use_preferred();
      }
    relative_tolerance = tolerance;
    matrix.add_to_diagonal(damping);

    solution.resize(right_hand_side.size());
    const Epetra_Map &map = matrix.OperatorRangeMap();
    Epetra_Vector b(Copy, map, const_cast<double *>(right_hand_side.data()));
    Epetra_Vector x(View, map, solution.data());
    if (multigrid &&
        solve_by_multigrid(matrix, b, shift_unit, x, indefinite, outcome))
      return outcome;
    if (blocks && solve_by_blocks(matrix, b, x, outcome))
      return outcome;

    // What made it too coarse will be there again, unless it is the matrix.
    const auto give_way_to = [&](const DirectFactor::Precision chosen) {
      use(chosen);
      gave_way = true;
      matrix.add_to_diagonal(-outcome.shift);
      outcome.shift = 0;
    };
    if (sections)
      {
        if (solve_by_sections(matrix, q, b, shift_unit, x, indefinite, outcome))
          return outcome;
        give_way_to(precision);
      }
    const auto solve_by_current_factor = [&]() {
      return solve_by_factor(matrix, b, shift_unit, x, indefinite, outcome);
    };
    if (!solve_by_current_factor())
      {
        give_way_to(DirectFactor::Precision::double_precision);
        solve_by_current_factor();
      }
    was_indefinite = outcome.negative_pivots > 0;
    return outcome;
  }



  bool
  LinearSolver::solve_again(BlockMatrix               &matrix,
                            const std::vector<double> &right_hand_side,
                            const double               tolerance,
                            std::vector<double>       &solution,
                            Outcome                   &outcome)
  {
    solution.resize(right_hand_side.size());
    const Epetra_Map &map = matrix.OperatorRangeMap();
    Epetra_Vector b(Copy, map, const_cast<double *>(right_hand_side.data()));
    Epetra_Vector x(View, map, solution.data());
    if (multigrid)
      return iterate(
        matrix, multigrid->preconditioner(), b, x, tolerance, outcome);
    if (sections)
      return iterate(matrix,
                     *sections,
                     b,
                     x,
                     tolerance,
                     outcome,
                     false,
                     largest_section_cycles);
    FactorPreconditioner preconditioner(*factor, matrix);
    return iterate(matrix, preconditioner, b, x, tolerance, outcome);
  }



  bool
  LinearSolver::solve_coupled(BlockMatrix               &matrix,
                              const std::vector<double> &right_hand_side,
                              const double               tolerance,
                              std::vector<double>       &solution,
                              Outcome                   &outcome)
  {
    matrix.use_outer_products(true);
    const bool found =
      solve_again(matrix, right_hand_side, tolerance, solution, outcome);
    matrix.use_outer_products(false);
    return found;
  }



  void
  LinearSolver::factorize(BlockMatrix           &matrix,
                          const Eigen::VectorXd &q,
                          Outcome               &outcome)
  {
    if (multigrid)
      return;
    {
      ScopedTimer timer(outcome.analysis);
      if (sections)
        sections->analyse(matrix, q);
      else
        factor->analyse(matrix);
    }
    constexpr double dropped = 0;
    timed(outcome, [&]() {
      return sections ? sections->factorize(matrix, dropped) :
                        factor->factorize(matrix);
    });
  }



  bool
  LinearSolver::solve_by_sections(BlockMatrix           &matrix,
                                  const Eigen::VectorXd &q,
                                  Epetra_Vector         &b,
                                  const double           shift_unit,
                                  Epetra_Vector         &x,
                                  const Indefinite       indefinite,
                                  Outcome               &outcome)
  {
    {
      ScopedTimer timer(outcome.analysis);
      sections->analyse(matrix, q);
    }
    for (unsigned int attempt = 0; attempt <= largest_single_shifts; ++attempt)
      {
        if (attempt > 0)
          shift_more(matrix, attempt, shift_unit, outcome);
        const double dropped = dropped_over_damping * matrix.least_addition();
        const int    negative_pivots = timed(outcome, [&]() {
          return sections->factorize(matrix, dropped);
        });
        if (attempt == 0)
          outcome.negative_pivots = negative_pivots;
        if (negative_pivots != 0 && indefinite == Indefinite::refused)
          return true;
        if (negative_pivots < 0 ||
            (negative_pivots > 0 && indefinite == Indefinite::shifted))
          continue;
        if (!iterate(matrix,
                     *sections,
                     b,
                     x,
                     relative_tolerance,
                     outcome,
                     false,
                     largest_section_cycles))
          {
            // Nearly singular: more damping helps a damped step, and is far
            // cheaper than a factor of the whole.
            if (dropped == 0 || indefinite != Indefinite::shifted)
              return false;
            continue;
          }
        // Motions and strains may both be definite where the whole is not.
        double slope;
        x.Dot(b, &slope);
        if (slope < 0 && indefinite == Indefinite::refused)
          outcome.negative_pivots = 1;
        if (slope >= 0 || indefinite != Indefinite::shifted)
          return true;
      }
    return false;
  }



  bool
  LinearSolver::solve_by_factor(BlockMatrix     &matrix,
                                Epetra_Vector   &b,
                                const double     shift_unit,
                                Epetra_Vector   &x,
                                const Indefinite indefinite,
                                Outcome         &outcome)
  {
    const bool in_single =
      precision == DirectFactor::Precision::single_precision;
    {
      ScopedTimer timer(outcome.analysis);
      factor->analyse(matrix);
    }
    for (unsigned int attempt = 0;; ++attempt)
      {
        const int negative_pivots =
          timed(outcome, [&]() { return factor->factorize(matrix); });
        if (attempt == 0)
          outcome.negative_pivots = negative_pivots;
        if (negative_pivots != 0 && indefinite == Indefinite::refused)
          return true;
        if (negative_pivots == 0 ||
            (negative_pivots > 0 && indefinite == Indefinite::accepted))
          break;
        if (in_single && attempt == largest_single_shifts)
          return false;
        shift_more(matrix, attempt, shift_unit, outcome);
      }
    FactorPreconditioner preconditioner(*factor, matrix);
    return iterate(matrix, preconditioner, b, x, relative_tolerance, outcome) ||
           !in_single;
  }



  void
  LinearSolver::use(const DirectFactor::Precision chosen)
  {
    sections.reset(); // first, for the memory
    factor.reset();
    precision = chosen;
    factor =
      std::make_unique<DirectFactor>(system.layout().communicator(), chosen);
  }



  bool
  LinearSolver::solve_by_multigrid(BlockMatrix     &matrix,
                                   Epetra_Vector   &b,
                                   const double     shift_unit,
                                   Epetra_Vector   &x,
                                   const Indefinite indefinite,
                                   Outcome         &outcome)
  {
    outcome.negative_pivots = -1;
    for (unsigned int attempt = 0;; ++attempt)
      {
        {
          ScopedTimer timer(outcome.analysis);
          multigrid->build(matrix);
        }
        if (!iterate(matrix,
                     multigrid->preconditioner(),
                     b,
                     x,
                     relative_tolerance,
                     outcome))
          return false;
        double slope;
        x.Dot(b, &slope);
        if (slope >= 0 || indefinite != Indefinite::shifted)
          return true;
        shift_more(matrix, attempt, shift_unit, outcome);
      }
  }



  bool
  LinearSolver::solve_by_blocks(BlockMatrix   &matrix,
                                Epetra_Vector &b,
                                Epetra_Vector &x,
                                Outcome       &outcome)
  {
    {
      ScopedTimer timer(outcome.analysis);
      blocks->analyse(matrix);
    }
    outcome.negative_pivots =
      timed(outcome, [&]() { return blocks->factorize(matrix); });
    if (outcome.negative_pivots != 0 ||
        !iterate(matrix, *blocks, b, x, relative_tolerance, outcome))
      return false;
    // Both blocks may be definite where the whole is not.
    double slope;
    x.Dot(b, &slope);
    return slope >= 0;
  }



  void
  LinearSolver::forget()
  {
    if (gave_way)
      {
        factor.reset();
        use_preferred();
      }
    if (factor)
      factor->forget();
    if (sections)
      sections->forget();
    if (blocks)
      blocks->forget();
  }



  void
  add(StageStatistics &statistics, const LinearSolver::Outcome &outcome)
  {
    statistics.linear_iterations += outcome.iterations;
    statistics.factorizations += outcome.factorizations;
    statistics.seconds.analysis += outcome.analysis;
    statistics.seconds.factorization += outcome.factorization;
    statistics.seconds.krylov += outcome.krylov;
  }



  double
  LinearSolver::time_double_factorization(const BlockMatrix &matrix)
  {
    DirectFactor factor(matrix.layout().communicator(),
                        DirectFactor::Precision::double_precision,
                        DirectFactor::Part::all,
                        DirectFactor::Entries::all);
    factor.analyse(matrix);
    double seconds = 0;
    {
      ScopedTimer timer(seconds);
      factor.factorize(matrix);
    }
    return seconds;
  }
} // namespace fiberloom
