// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_solvers_linear_solver_h
#define fiberloom_solvers_linear_solver_h

#include <fiberloom/base/choices.h>
#include <fiberloom/base/statistics.h>

#include <fiberloom/solvers/block_preconditioner.h>
#include <fiberloom/solvers/direct_factor.h>
#include <fiberloom/solvers/multigrid.h>
#include <fiberloom/solvers/section_preconditioner.h>

#include <Epetra_Vector.h>

#include <memory>
#include <vector>

namespace fiberloom
{
  /**
   * Solves the system of a Newton iteration by a Krylov method of Trilinos in
   * double precision around a MUMPS factor of the symmetric part in single or
   * double precision. Only moments on free bodies make it unsymmetric. An
   * indefinite matrix gets a diagonal shift that grows until it is not, so that
   * the solution is a direction of descent.
   *
   * A large system has only the motions of rigid sections factorised, in single
   * precision. Where that does not converge, the factor of the whole takes its
   * place, and one in single precision around which the method does not
   * converge either, or that stays indefinite, gives way to one in double
   * precision; both until forget().
   *
   * For a composite, blocks asks for a factor of the fibers and one of the
   * matrix in place of that of both. Section 8 of the theory.
   *
   * Multigrid stands in for the factor where asked for; it does not count
   * negative pivots, so a solution that is no descent tells that the matrix is
   * indefinite. Systems for which it does not converge get the factor.
   */
  class LinearSolver
  {
  public:
    /**
     * @p system is kept by reference; @p wanted : what the user asks for, which
     * together with the number of dofs decides on the preconditioner.
     */
    LinearSolver(const System &system, const Preconditioning wanted);

    /** What becomes of an indefinite matrix: it is shifted until it is not,
     * solved as it is, or nothing is solved. */
    enum class Indefinite
    {
      shifted,
      accepted,
      refused
    };

    /** What a solution took. */
    struct Outcome
    {
      unsigned int iterations      = 0;
      unsigned int factorizations  = 0;
      double       shift           = 0;    // [N/mm]
      int          negative_pivots = 0;    // without shift; -1: unknown
      bool         converged       = true; // false: the best there is
      double       analysis        = 0;    // or coarsening [s], as the next two
      double       factorization   = 0;
      double       krylov          = 0;
    };

    /**
     * The system matrix * x = right_hand_side, whose residual is reduced to
     * @p tolerance times the right hand side. Owned parts of vectors have
     * BlockLayout::n_owned_dofs() entries: forces [N] and moments on bodies
     * [N mm] on the right, increments [mm], [rad] in the solution.
     */
    struct Equations
    {
      BlockMatrix               &matrix;
      const std::vector<double> &right_hand_side; // the owned part
      double                     tolerance = 1e-9;
    };

    /**
     * What the diagonal of the matrix gets [N/mm]: @p damping in any case, and
     * @p shift_unit more in the first attempt to shift an indefinite
     * matrix.
     */
    struct Diagonal
    {
      double     damping;
      double     shift_unit;
      Indefinite indefinite = Indefinite::shifted;
    };

    /**
     * Solves @p equations ; damping and shifts stay in their matrix. @p q : the
     * dofs of the fibers, nine for each node, which tell where their sections
     * are. @p solution : the owned part, resized. With Indefinite::refused
     * there is none where the outcome has negative pivots. Throws StageFailure
     * where the matrix stays indefinite for every shift.
     */
    Outcome
    solve(const Equations       &equations,
          const Eigen::VectorXd &q,
          const Diagonal        &diagonal,
          std::vector<double>   &solution);

    /**
     * Solves @p equations around what preconditioned the last system, of the
     * same matrix, and adds to @p outcome what that takes. False where it does
     * not converge.
     */
    bool
    solve_again(const Equations     &equations,
                std::vector<double> &solution,
                Outcome             &outcome);

    /**
     * Factorises @p matrix without its outer products, definite or not, so that
     * coupled systems can be solved around the factor; @p q as in solve(). Does
     * nothing with multigrid, whose last preconditioner is used.
     */
    void
    factorize(BlockMatrix &matrix, const Eigen::VectorXd &q, Outcome &outcome);

    /**
     * Solves @p equations with the outer products of the matrix, around what
     * preconditioned the last system and from the @p solution that is there
     * already, if any. Adds to @p outcome what that takes. False where it does
     * not converge.
     */
    bool
    solve_coupled(const Equations     &equations,
                  std::vector<double> &solution,
                  Outcome             &outcome);

    /**
     * Forgets what was kept of earlier systems to save time: from here on, a
     * run that is restarted does the same as one that goes on.
     */
    void
    forget();

    /**
     * Factorises @p matrix once in double precision and returns the time that
     * takes [s].
     */
    static double
    time_double_factorization(const BlockMatrix &matrix);

  private:
    /**
     * Chooses the preconditioner that the user asks for or the number of dofs
     * suggests.
     */
    void
    use_preferred();

    /**
     * Takes an empty factor of the whole in @p chosen precision in place of
     * what was used.
     */
    void
    use(const DirectFactor::Precision chosen);

    /** Makes the factor of @p matrix what preconditions. */
    void
    use_factor_of(const BlockMatrix &matrix);

    /** Most cycles of Krylov's method around what preconditioned last. */
    unsigned int
    cycles_of_last() const;

    /** Equations with their solution and what it takes. */
    struct Task;

    /**
     * Solves @p task around a factor of the motions of rigid sections. False
     * where that does not come to its end with a descent.
     */
    bool
    solve_by_sections(Task                  &task,
                      const Eigen::VectorXd &q,
                      const Diagonal        &diagonal);

    /**
     * Solves @p task around a factor of the whole. False where this factor is
     * too coarse.
     */
    bool
    solve_by_factor(Task &task, const Diagonal &diagonal);

    /** Solves @p task around multigrid. False where that does not converge. */
    bool
    solve_by_multigrid(Task &task, const Diagonal &diagonal);

    /**
     * Solves @p task around one factor of the fibers and one of the matrix.
     * False where that does not come to its end with a descent.
     */
    bool
    solve_by_blocks(Task &task);

    const System                          &system;
    const Preconditioning                  wanted;
    bool                                   gave_way       = false;
    bool                                   was_indefinite = false;
    DirectFactor::Precision                precision;
    std::unique_ptr<DirectFactor>          factor;         // or null
    std::unique_ptr<Preconditioner>        by_factor;      // or null
    std::unique_ptr<SectionPreconditioner> sections;       // or null
    std::unique_ptr<BlockPreconditioner>   blocks;         // or null
    std::unique_ptr<Multigrid>             multigrid;      // or null
    Epetra_Operator                       *last = nullptr; // that was applied
  };

  /**
   * Adds what @p outcome took to @p statistics : iterations, factorisations and
   * seconds.
   */
  void
  add(StageStatistics &statistics, const LinearSolver::Outcome &outcome);
} // namespace fiberloom

#endif
