// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_stages_load_h
#define fiberloom_stages_load_h

#include <fiberloom/base/vector_function.h>

#include <fiberloom/fabric/fiber_points.h>

#include <fiberloom/stages/load_settings.h>
#include <fiberloom/stages/stage.h>

#include <vector>

namespace fiberloom
{
  struct DriveParameters;

  /**
   * Moves and loads fibers as the scene says: each drive is a rigid body that
   * holds some points, whose six dofs follow functions of t or are free under a
   * dead force and moment; loads along the fibers are added. t runs from 0 to
   * LoadSettings::end while the load of the stage goes from 0 to 1. Section 5.6
   * of the theory; section 6.1 of the paper drives the ends of tows in this
   * way.
   */
  class Load : public Stage
  {
  public:
    /** Name, description and entries of the stage. */
    static StageType
    type();

    /**
     * Throws InputError where drives and fibers do not go together: points or
     * borders that are not there, or a free motion that nothing hinders.
     */
    explicit Load(const Scene &scene);

    /**
     * One body for each drive, with the fiber nodes and the nodes of the
     * matrix's borders that it holds; a node on two borders goes with the first
     * drive. Throws InputError where the matrix has no such border.
     */
    Supports
    supports(const DofVector &start) const override;

    /**
     * Places each body, unrotated, at the center of its drive or, where none is
     * given, at the mean of the nodes that it holds.
     */
    void
    begin(State &state) const override;

    /**
     * Targets of the drives at @p load : the placement at the start, moved by
     * the translation [mm] and turned by the rotation vector [rad] at t, and
     * the force [N] and moment [N mm] on free dofs. Throws StageFailure where a
     * function is not finite.
     */
    std::vector<BodyTarget>
    targets(const std::vector<Placement> &start,
            const double                  load) const override;

    /**
     * The dead force on the centre of each fiber node at @p load [N]: the
     * integral of its shape function times line load plus weight. Empty where
     * there is neither. Throws StageFailure where a function is not finite.
     */
    std::vector<Vector3>
    node_forces(const double load) const override;

    /**
     * The first step of t that the scene asks for, at most the largest one,
     * over the end of t.
     */
    double
    first_step(const State &state) const override;

    /**
     * The largest step of t, over the end of t: that of the scene, or a shorter
     * one where a drive would turn by more than LoadSettings::largest_turn.
     */
    double
    largest_step() const override;

    /** The next load beyond @p load where t is a whole number, at most 1. */
    double
    next_stop(const double load) const override;

    bool
    shows_balance() const override
    {
      return true;
    }

    std::vector<std::string>
    notes() const override
    {
      return snapped_points;
    }

    /**
     * Columns of the loading curve: t; position [mm], turn [rad], force [N] and
     * moment [N mm] of each body; its force along the direction in which it is
     * driven, if it is; and the positions of the probes [mm].
     */
    CurveRow
    curve(const State                   &state,
          const std::vector<BodyVector> &reactions) const override;

  private:
    struct Drive
    {
      explicit Drive(const DriveParameters &parameters);

      const DriveParameters    &parameters;
      std::vector<unsigned int> nodes;
      VectorFunction            translation, rotation, force, moment;
      Vector3                   direction; // of force_NAME, 0: none

      std::string
      entry(const std::string &name) const;
    };

    /** Place of the drive's reference point where the fibers are at @p q . */
    Vector3
    reference_point(const Drive &drive, const DofVector &q) const;

    /**
     * Sets the nodes of @p drive to those nearest to the points that it names.
     */
    void
    find_nodes(Drive &drive);

    /**
     * The nodes of the matrix on the borders that @p drive holds. Throws
     * InputError where no layer has such a border.
     */
    std::vector<unsigned int>
    matrix_nodes(const Drive &drive) const;

    /**
     * How the fiber nodes of drive number @p d are held where the stage starts
     * at @p start . Throws InputError where that cannot be.
     */
    std::vector<Attachment>
    fiber_attachments(const unsigned int d, const DofVector &start) const;

    /**
     * Throws InputError where nothing hinders a free motion of drive number
     * @p d .
     */
    void
    check_support(const unsigned int d) const;

    /** Sets the length and the mass that each fiber node carries. */
    void
    distribute_loads();

    /**
     * @p function at @p t ; throws StageFailure, with the name of its
     * @p entry , where it is not finite.
     */
    Vector3
    finite_value(const VectorFunction &function,
                 const double          t,
                 const std::string    &entry) const;

    const LoadSettings       settings;
    std::vector<Drive>       drives;
    std::vector<FiberPoint>  probes;
    VectorFunction           line_load, gravity;
    std::vector<double>      length_of_node;    // loaded length [mm]
    std::vector<double>      mass_of_node;      // loaded mass [t]
    bool                     is_loaded = false; // along the fibers
    double                   step;              // largest, of t
    std::vector<std::string> snapped_points;
  };
} // namespace fiberloom

#endif
