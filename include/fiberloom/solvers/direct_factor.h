// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_solvers_direct_factor_h
#define fiberloom_solvers_direct_factor_h

#include <fiberloom/model/block_matrix.h>

#include <memory>

namespace fiberloom
{
  class RigidSections;

  /**
   * A distributed symmetric factorisation, of the symmetric part of a matrix,
   * by MUMPS, called directly because no interface of deal.II or Trilinos
   * passes on symmetry, ordering or precision. The fill-reducing ordering is
   * METIS's on the graph of blocks, expanded to dofs. LDL^T without pivoting
   * tells the number of negative pivots, so an indefinite matrix is seen.
   * Section 8 of the theory.
   */
  class DirectFactor
  {
  public:
    enum class Precision
    {
      single_precision,
      double_precision
    };

    /** What of a composite is factorised; the rest counts as the unit matrix.
     */
    enum class Part
    {
      all,
      fibers_and_bodies,
      matrix
    };

    /** Which couplings of two blocks are factorised: open contacts leave
     * theirs zero. */
    enum class Entries
    {
      nonzero,
      all
    };

    /** Where @p sections are given, which are kept by reference, only their
     * motions are factorised, with low-rank blocks, and vectors are in their
     * layout. */
    DirectFactor(const MPI_Comm       comm,
                 const Precision      precision,
                 const Part           part     = Part::all,
                 const Entries        entries  = Entries::nonzero,
                 const RigidSections *sections = nullptr);
    ~DirectFactor();

    /**
     * Analyses the couplings of @p matrix if there are others than before. The
     * ordering is kept for as long as the factor costs little more than with
     * the one that was new. Throws StageFailure.
     */
    void
    analyse(const BlockMatrix &matrix);

    /**
     * Lets the next matrix be analysed as if it were the first: what follows
     * does not depend on earlier ones.
     */
    void
    forget();

    /**
     * Factorises @p matrix , which has been analysed. Returns the number of
     * negative pivots, or -1 when the factorisation failed (singular). Throws
     * StageFailure when memory runs out. Blocks of low rank leave out
     * @p dropped , an absolute size [N/mm].
     */
    int
    factorize(const BlockMatrix &matrix, const double dropped = 0);

    /**
     * Solves for @p owned_values , the owned part of a vector in @p layout , in
     * place: forces [N] before, increments [mm] after. Collective.
     */
    void
    solve(const BlockLayout &layout, double *owned_values);

  private:
    class Implementation;
    template <typename Mumps, typename Real>
    class Typed;
    std::unique_ptr<Implementation> implementation;
  };
} // namespace fiberloom

#endif
