// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_solvers_fiber_bounds_h
#define fiberloom_solvers_fiber_bounds_h

#include <fiberloom/model/system.h>

#include <vector>

namespace fiberloom
{
  /**
   * A trust region that bounds each fiber by itself, so that a few loose ones
   * do not hold back all the others. Each bound has a multiplier, which is
   * added to the diagonal of its fiber: Levenberg's method fiber by fiber.
   * Multipliers are kept from one iteration to the next.
   */
  class FiberBounds
  {
  public:
    /** References are kept. @p largest_move : of a fiber, over its radius; 0:
     * there are no bounds. */
    FiberBounds(const FiberMesh &mesh,
                System          &system,
                const double     largest_move);

    /** Whether fibers that nothing else holds may move on. */
    bool
    hold_some() const;

    void
    release();

    void
    add_to_matrix();

    /**
     * Sets multipliers by what a @p step led to, in all dofs @p increment ,
     * @p gradient being the system's right hand side. Those that are to grow
     * also do so in the matrix if @p at_once ; otherwise all are set, for the
     * next matrix.
     */
    void
    update(const std::vector<double> &gradient,
           const std::vector<double> &step,
           const Eigen::VectorXd     &increment,
           const bool                 at_once);

    /** Cuts @p step , in all dofs @p increment , fiber by fiber. */
    void
    cut(std::vector<double> &step, const Eigen::VectorXd &increment) const;

  private:
    /** Largest moves of fibers, over what they are allowed. */
    std::vector<double>
    moves(const Eigen::VectorXd &increment) const;

    void
    add_to_matrix(const std::vector<double> &multipliers);

    /** Calls @p function with each dof of fibers on this rank and its fiber. */
    template <typename Function>
    void
    for_each_dof(const Function &function) const;

    const FiberMesh          &mesh;
    System                   &system;
    const double              largest_move;
    std::vector<unsigned int> fiber_of_node;
    std::vector<double>       multipliers; // of fibers [N/mm]
  };
} // namespace fiberloom

#endif
