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
   * holds some points, whose six dofs follow functions of t or are free under
   * a dead force and moment; loads along the fibers are added. t runs from 0 to
   * LoadSettings::end while the load of the stage goes from 0 to 1.
   */
  class Load : public Stage
  {
  public:
    static StageType
    type();

    /** Throws InputError where drives and fibers do not go together. */
    explicit Load(const Scene &scene);

    Supports
    supports(const DofVector &start) const override;

    void
    begin(State &state) const override;

    std::vector<BodyTarget>
    targets(const std::vector<Placement> &start,
            const double                  load) const override;

    std::vector<Vector3>
    node_forces(const double load) const override;

    double
    first_step(const State &state) const override;

    double
    largest_step() const override;

    /** Where t is whole. */
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

    void
    find_nodes(Drive &drive);

    /** On the borders that the drive holds. Throws InputError where no layer
     * has such a border. */
    std::vector<unsigned int>
    matrix_nodes(const Drive &drive) const;

    std::vector<Attachment>
    fiber_attachments(const unsigned int d, const DofVector &start) const;

    /** Throws InputError when a free motion of drive @p d meets no
     * resistance. */
    void
    check_support(const unsigned int d) const;

    void
    distribute_loads();

    /** Of the function of @p entry ; throws StageFailure where it is none. */
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
