// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_solvers_moving_fibers_h
#define fiberloom_solvers_moving_fibers_h

#include <fiberloom/model/system.h>

#include <vector>

namespace fiberloom
{
  /**
   * The fibers that an iteration moves: all, or the few that still go far while
   * all others hardly move and so may as well stand still. The equations of
   * these few cost little, and most of what the others will have to do depends
   * on where they come to rest (nonlinear elimination: Cai and Li, SIAM J. Sci.
   * Comput. 33, 2011). The system is restricted to them.
   */
  class MovingFibers
  {
  public:
    /** References are kept. */
    MovingFibers(const FiberMesh &mesh, System &system);

    bool
    are_all() const
    {
      return moving.empty();
    }

    /** From here on all fibers move again. */
    void
    release();

    /**
     * Chooses the fibers that went further than @p part of the furthest of all
     * @p moves ; all, if they are more than this part of the fibers.
     */
    void
    choose(const std::vector<double> &moves, const double part);

    /** Sets what belongs to others to zero, in the owned dofs. */
    void restrict(std::vector<double> &values) const;

    /**
     * Reduces the system's matrix to the rows and columns of those that move;
     * others keep a diagonal only.
     */
    void
    restrict_matrix() const;

    /**
     * Takes note of the unbalanced forces of all fibers. Whether those of the
     * moving ones are still above @p part of what they were and above those of
     * the others, in fewer than @p most iterations; then the system is
     * restricted to them again.
     */
    bool
    are_worth_it(const double part, const unsigned int most);

  private:
    const FiberMesh  &mesh;
    System           &system;
    std::vector<char> moving;         // blocks; empty: all
    double            first      = 0; // unbalanced force, to begin with [N]
    unsigned int      iterations = 0;
  };
} // namespace fiberloom

#endif
