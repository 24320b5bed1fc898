// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_solvers_direct_factor_h
#define fiberloom_solvers_direct_factor_h

#include <fiberloom/model/block_matrix.h>

#include <memory>
#include <vector>

namespace fiberloom
{
  /**
   * A distributed symmetric factorisation, of the symmetric part of a matrix,
   * by MUMPS, called directly because no
   * interface of deal.II or Trilinos passes on symmetry, ordering or
   * precision. The fill-reducing ordering is METIS's on the graph of blocks,
   * expanded to dofs. LDL^T without pivoting tells the number of negative
   * pivots, so an indefinite matrix is seen.
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

    DirectFactor(const MPI_Comm  comm,
                 const Precision precision,
                 const Part      part = Part::all);
    ~DirectFactor();

    /**
     * Analyses the pattern of @p matrix if it has changed; throws
     * StageFailure. The ordering is kept for as long as the factor costs
     * little more than with the one that was new.
     */
    void
    analyse(const BlockMatrix &matrix);

    /** The next pattern is ordered anew. */
    void
    forget_ordering();

    /**
     * Factorises @p matrix , which has been analysed. Returns the number of
     * negative pivots, or -1 when the factorisation failed (singular). Throws
     * StageFailure when memory runs out.
     */
    int
    factorize(const BlockMatrix &matrix);

    /** Solves for the owned parts in place. */
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
