// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_solvers_damping_h
#define fiberloom_solvers_damping_h

#include <fiberloom/beams/fiber_mesh.h>

#include <Eigen/Core>

#include <vector>

namespace fiberloom
{
  /**
   * The diagonal that the damped loop adds to the tangent, in theory 4.3, and
   * what the loop's steps make of it: more where fibers are thrown, less where
   * they only creep.
   */
  class Damping
  {
  public:
    /** None to begin with. The reference is kept. */
    Damping(const FiberMesh &mesh);

    /** For a new loop: @p least over E r, 0 for Newton's method proper. */
    void
    reset(const double least);

    /** Of fibers that do not have more, over E r. */
    double
    over_Er() const
    {
      return value;
    }

    /** Whether it has been lowered where residuals told of creep only. */
    bool
    is_quiet() const
    {
      return quiet;
    }

    bool
    cycles() const
    {
      return cycling;
    }

    /** Whether the last step ended one. */
    bool
    has_ended_cycle() const
    {
      return ended;
    }

    /** Of each of @p n_blocks blocks [N/mm] at the stiffness E r. */
    std::vector<double>
    of_blocks(const unsigned int n_blocks, const double stiffness) const;

    /** What to take of a step that goes back on the one before. */
    double
    relaxation(const Eigen::VectorXd &increment) const;

    /** Less while the residuals so far tell of creep only, or in cycles. */
    void
    follow(const std::vector<double> &residuals);

    /** From the next iteration on in cycles of less and of usual damping: what
     * is left is slow. */
    void
    cycle();

    /** After a line search has left the part @p cut of a step. */
    void
    follow_cut(const double cut);

    /** What fibers went in @p step , for relaxation(). */
    void
    remember(const Eigen::VectorXd &step);

    /** More for those that went far in it, less for others; @p ends : what
     * the ends of the fabric were moved by, over the radius. */
    void
    follow_fibers(const double ends);

  private:
    const FiberMesh    &mesh;
    double              least = 0, value = 0;
    bool                quiet   = false;
    bool                cycling = false, ends = false, ended = false;
    unsigned int        position = 0; // in the cycle
    unsigned int        patience = 0; // iterations before it is quiet
    std::vector<double> of_lines;     // over the value; may be empty
    Eigen::VectorXd     last_step;
  };
} // namespace fiberloom

#endif
