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
   * Multipliers are kept from one iteration to the next. Section 4.4 of the
   * theory.
   */
  class FiberBounds
  {
  public:
    /** References are kept. @p largest_move : of a fiber, over its radius,
     * above 0 wherever a bound is asked for. */
    FiberBounds(const FiberMesh &mesh,
                System          &system,
                const double     largest_move);

    /** Whether a multiplier is not zero. */
    bool
    hold_any() const;

    /** Sets all multipliers to zero. */
    void
    release();

    /**
     * Adds the multipliers to the diagonals of their fibers in the system's
     * matrix.
     */
    void
    add_to_matrix();

    /**
     * Raises multipliers of fibers that @p step , in all dofs @p increment ,
     * sends too far, in the matrix as well. @p gradient : the right hand side
     * that led to it.
     */
    void
    hold(const std::vector<double> &gradient,
         const std::vector<double> &step,
         const Eigen::VectorXd     &increment);

    /**
     * Raises multipliers as hold() does, and lowers those of fibers within
     * their bounds, for the next matrix only.
     */
    void
    prepare_next(const std::vector<double> &gradient,
                 const std::vector<double> &step,
                 const Eigen::VectorXd     &increment);

    /** Cuts @p step , in all dofs @p increment , fiber by fiber. */
    void
    cut(std::vector<double> &step, const Eigen::VectorXd &increment) const;

  private:
    /** Largest moves of fibers, over what they are allowed. */
    std::vector<double>
    moves(const Eigen::VectorXd &increment) const;

    /** Stiffness of each fiber along its part of @p step [N/mm]. */
    std::vector<double>
    stiffness(const std::vector<double> &gradient,
              const std::vector<double> &step) const;

    /** Raises multipliers where @p moves are beyond the bound. */
    void
    raise(const std::vector<double> &moves,
          const std::vector<double> &stiffness);

    /** Sets to zero what holds nothing. */
    void
    drop_least();

    void
    add_to_matrix(const std::vector<double> &multipliers);

    /** Calls @p function with each dof of fibers on this rank and its fiber. */
    template <typename Function>
    void
    for_each_dof(const Function &function) const;

    const FiberMesh    &mesh;
    System             &system;
    const double        largest_move;
    std::vector<double> multipliers; // of fibers [N/mm]
  };
} // namespace fiberloom

#endif
