// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_solvers_damping_h
#define fiberloom_solvers_damping_h

#include <fiberloom/beams/fiber_mesh.h>

#include <fiberloom/coupling/rigid_body.h>

#include <Eigen/Core>

#include <algorithm>
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

    /** Not less than outside of cycles and quiet ends. */
    double
    usual_over_Er() const
    {
      return std::max(value, least);
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

    /**
     * Whether the forces in @p reactions have come to rest. Where steps go on
     * changing them although other forces are @p balanced to @p tolerance ,
     * what is left is slow: damping goes over to cycles, from one to the next
     * of which forces are compared then.
     */
    bool
    follow_reactions(const std::vector<BodyVector> &reactions,
                     const bool                     balanced,
                     const double                   tolerance);

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
    /** Largest change of a force since the last call, over the largest force.
     */
    double
    change(const std::vector<BodyVector> &reactions);

    const FiberMesh     &mesh;
    double               least = 0, value = 0;
    bool                 quiet = false, balanced = false;
    unsigned int         patience = 0; // iterations before it is quiet
    bool                 cycles = false, cycle_ended = false;
    unsigned int         position    = 0; // steps of the cycle so far
    unsigned int         n_waits     = 0; // steps after it
    unsigned int         n_slow      = 0; // steps in a row that changed forces
    double               first_drift = 0; // of the first of them
    std::vector<double>  of_lines;        // over the value; may be empty
    Eigen::VectorXd      last_step;
    std::vector<Vector3> last_forces;
  };
} // namespace fiberloom

#endif
