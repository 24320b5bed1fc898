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

    // Where corrections leave more than this part of the residual, Krylov's
    // method needs fewer.
    constexpr double largest_contraction = .25;

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



  LinearSolver::LinearSolver(const System &system, const Preconditioning wanted)
    : system(system)
    , wanted(wanted)
    , multigrid(wanted == Preconditioning::multigrid ?
                  std::make_unique<Multigrid>(system.rigid_modes()) :
                  nullptr)
  {
    use_preferred();
    if (wanted == Preconditioning::blocks)
      blocks =
        std::make_unique<BlockPreconditioner>(system.layout().communicator(),
                                              precision);
  }



  void
  LinearSolver::use_preferred()
  {
    const unsigned int n_dofs   = system.layout().n_dofs();
    const bool         is_small = n_dofs < single_precision_from;
    precision                   = wanted == Preconditioning::double_factor ||
                    (is_small && (wanted == Preconditioning::automatic ||
                                  wanted == Preconditioning::blocks)) ?
                                    DirectFactor::Precision::double_precision :
                                    DirectFactor::Precision::single_precision;
    if (wanted == Preconditioning::rigid_sections ||
        (n_dofs >= rigid_sections_from && wanted == Preconditioning::automatic))
      sections = std::make_unique<SectionPreconditioner>(system, precision);
    else
      use(precision);
    gave_way = false;
  }



  struct LinearSolver::Task
  {
    Task(const Equations     &equations,
         std::vector<double> &solution,
         Outcome             &outcome)
      : matrix(equations.matrix)
      , tolerance(equations.tolerance)
      , b(Copy,
          matrix.OperatorRangeMap(),
          const_cast<double *>(equations.right_hand_side.data()))
      , x(View, matrix.OperatorRangeMap(), resized(solution).data())
      , outcome(outcome)
    {}

    /** Whether the true residual has become small: by corrections with @p
     * preconditioner alone as long as these do, then by Krylov's method. */
    bool
    iterate(Epetra_Operator &preconditioner, const unsigned int cycles);

    /** The same from the solution as it is. */
    bool
    improve(Epetra_Operator &preconditioner, const unsigned int cycles);

    /** Of the solution. */
    bool
    descends() const
    {
      double slope;
      x.Dot(b, &slope);
      return slope >= 0;
    }

    BlockMatrix  &matrix;
    const double  tolerance;
    Epetra_Vector b, x;
    Outcome      &outcome;

  private:
    /** By Krylov's method. */
    bool
    go_on(Epetra_Operator &preconditioner, const unsigned int cycles);

    static double
    norm_of(const Epetra_Vector &vector)
    {
      double norm;
      vector.Norm2(&norm);
      return norm;
    }

    std::vector<double> &
    resized(std::vector<double> &solution) const
    {
      solution.resize(matrix.OperatorRangeMap().NumMyElements());
      return solution;
    }
  };



  bool
  LinearSolver::Task::iterate(Epetra_Operator   &preconditioner,
                              const unsigned int cycles)
  {
    x.PutScalar(0);
    return improve(preconditioner, cycles);
  }



  bool
  LinearSolver::Task::improve(Epetra_Operator   &preconditioner,
                              const unsigned int cycles)
  {
    {
      ScopedTimer   timer(outcome.krylov);
      const double  norm = norm_of(b);
      Epetra_Vector residual(b), product(b.Map()), correction(b.Map());
      double        start;
      x.NormInf(&start);
      if (start > 0)
        {
          matrix.Apply(x, product);
          residual.Update(-1, product, 1);
        }
      // Around a factor of the same matrix one correction is mostly enough,
      // around one of the motions of its sections two.
      for (double before = norm_of(residual), after = 0;
           before > tolerance * norm;
           before = after)
        {
          preconditioner.ApplyInverse(residual, correction);
          matrix.Apply(correction, product);
          ++outcome.iterations;
          residual.Update(-1, product, 1);
          after = norm_of(residual);
          if (!(after < before))
            break;
          x.Update(1, correction, 1);
          if (after <= tolerance * norm)
            return true;
          if (after > largest_contraction * before)
            break;
        }
    }
    return go_on(preconditioner, cycles);
  }



  bool
  LinearSolver::Task::go_on(Epetra_Operator   &preconditioner,
                            const unsigned int cycles)
  {
    ScopedTimer  timer(outcome.krylov);
    const double norm = norm_of(b);
    if (norm == 0)
      return true;
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
        krylov.Iterate(krylov_space, tolerance);
        outcome.iterations += krylov.NumIters();
        if (krylov.TrueResidual() <= tolerance * norm)
          return true;
      }
    return false;
  }



  namespace
  {
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
  LinearSolver::solve(const Equations       &equations,
                      const Eigen::VectorXd &q,
                      const Diagonal        &diagonal,
                      std::vector<double>   &solution)
  {
    Outcome outcome;
    if (gave_way && was_indefinite)
      {
        // The finer factor found the same: the coarser one was right.
        factor.reset();
        use_preferred();
      }
    BlockMatrix &matrix = equations.matrix;
    matrix.add_to_diagonal(diagonal.damping);

    Task task(equations, solution, outcome);
    if ((multigrid && solve_by_multigrid(task, diagonal)) ||
        (blocks && solve_by_blocks(task)))
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
        if (solve_by_sections(task, q, diagonal))
          return outcome;
        give_way_to(precision);
      }
    if (!solve_by_factor(task, diagonal))
      {
        give_way_to(DirectFactor::Precision::double_precision);
        solve_by_factor(task, diagonal);
      }
    was_indefinite = outcome.negative_pivots > 0;
    return outcome;
  }



  bool
  LinearSolver::solve_again(const Equations     &equations,
                            std::vector<double> &solution,
                            Outcome             &outcome)
  {
    Task task(equations, solution, outcome);
    return task.iterate(*last, cycles_of_last());
  }



  bool
  LinearSolver::solve_coupled(const Equations     &equations,
                              std::vector<double> &solution,
                              Outcome             &outcome)
  {
    equations.matrix.use_outer_products();
    Task       task(equations, solution, outcome);
    const bool found = task.improve(*last, cycles_of_last());
    equations.matrix.leave_out_outer_products();
    return found;
  }



  unsigned int
  LinearSolver::cycles_of_last() const
  {
    return sections ? largest_section_cycles : largest_cycles;
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
    if (sections)
      last = sections.get();
    else
      use_factor_of(matrix);
  }



  bool
  LinearSolver::solve_by_sections(Task                  &task,
                                  const Eigen::VectorXd &q,
                                  const Diagonal        &diagonal)
  {
    BlockMatrix &matrix     = task.matrix;
    Outcome     &outcome    = task.outcome;
    const auto   indefinite = diagonal.indefinite;
    {
      ScopedTimer timer(outcome.analysis);
      sections->analyse(matrix, q);
    }
    for (unsigned int attempt = 0; attempt <= largest_single_shifts; ++attempt)
      {
        if (attempt > 0)
          shift_more(matrix, attempt, diagonal.shift_unit, outcome);
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
        last = sections.get();
        if (!task.iterate(*last, largest_section_cycles))
          {
            // Nearly singular: more damping helps a damped step, and is far
            // cheaper than a factor of the whole.
            if (dropped == 0 || indefinite != Indefinite::shifted)
              return false;
            continue;
          }
        // Motions and strains may both be definite where the whole is not.
        const bool descends = task.descends();
        if (!descends && indefinite == Indefinite::refused)
          outcome.negative_pivots = 1;
        if (descends || indefinite != Indefinite::shifted)
          return true;
      }
    return false;
  }



  bool
  LinearSolver::solve_by_factor(Task &task, const Diagonal &diagonal)
  {
    const bool in_single =
      precision == DirectFactor::Precision::single_precision;
    Outcome &outcome = task.outcome;
    {
      ScopedTimer timer(outcome.analysis);
      factor->analyse(task.matrix);
    }
    for (unsigned int attempt = 0;; ++attempt)
      {
        const int negative_pivots =
          timed(outcome, [&]() { return factor->factorize(task.matrix); });
        if (attempt == 0)
          outcome.negative_pivots = negative_pivots;
        if (negative_pivots != 0 && diagonal.indefinite == Indefinite::refused)
          return true;
        if (negative_pivots == 0 ||
            (negative_pivots > 0 &&
             diagonal.indefinite == Indefinite::accepted))
          break;
        if (in_single && attempt == largest_single_shifts)
          return false;
        shift_more(task.matrix, attempt, diagonal.shift_unit, outcome);
      }
    use_factor_of(task.matrix);
    outcome.converged = task.iterate(*last, largest_cycles);
    return outcome.converged || !in_single;
  }



  void
  LinearSolver::use_factor_of(const BlockMatrix &matrix)
  {
    by_factor = std::make_unique<FactorPreconditioner>(*factor, matrix);
    last      = by_factor.get();
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
  LinearSolver::solve_by_multigrid(Task &task, const Diagonal &diagonal)
  {
    Outcome &outcome        = task.outcome;
    outcome.negative_pivots = -1;
    for (unsigned int attempt = 0;; ++attempt)
      {
        {
          ScopedTimer timer(outcome.analysis);
          multigrid->build(task.matrix);
        }
        last = &multigrid->preconditioner();
        if (!task.iterate(*last, largest_cycles))
          return false;
        if (task.descends() || diagonal.indefinite != Indefinite::shifted)
          return true;
        shift_more(task.matrix, attempt, diagonal.shift_unit, outcome);
      }
  }



  bool
  LinearSolver::solve_by_blocks(Task &task)
  {
    Outcome &outcome = task.outcome;
    {
      ScopedTimer timer(outcome.analysis);
      blocks->analyse(task.matrix);
    }
    outcome.negative_pivots =
      timed(outcome, [&]() { return blocks->factorize(task.matrix); });
    last = blocks.get();
    // Both blocks may be definite where the whole is not.
    return outcome.negative_pivots == 0 &&
           task.iterate(*last, largest_cycles) && task.descends();
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
