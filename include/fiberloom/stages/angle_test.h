// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_stages_angle_test_h
#define fiberloom_stages_angle_test_h

#include <fiberloom/base/choices.h>

#include <fiberloom/stages/tow_ends.h>

#include <algorithm>

namespace fiberloom
{
  /** Entries of a test by an angle. */
  struct AngleSettings
  {
    double largest_angle = 1;    // [rad]
    double first_step    = 0.05; // of the angle [rad]
    double largest_step  = 0.05; // of the angle [rad]

    std::vector<double> way = {1}; // parts of the largest angle

    void
    declare(ParameterCatalogue &catalogue);

    void
    resolve()
    {
      first_step = std::min(first_step, largest_step);
    }
  };



  /**
   * A test in which an angle goes its way and all bodies of a fabric, those on
   * tow ends and those on borders of the matrix, follow it by a formula.
   */
  class AngleTest : public Stage
  {
  public:
    AngleTest(const Scene &scene, const AngleSettings &angles);

    void
    begin(State &state) const override;

    Past
    guess(const State &state, const double load_step) const override;

    std::vector<BodyTarget>
    targets(const std::vector<Placement> &start,
            const double                  load) const override;

    double
    first_step(const State &) const override
    {
      return angles.first_step / (angles.largest_angle * turning.length());
    }

    double
    largest_step() const override
    {
      return angles.largest_step / (angles.largest_angle * turning.length());
    }

    const Way *
    way() const override
    {
      return &turning;
    }

    bool
    shows_neighbors() const override
    {
      return true;
    }

  protected:
    /** Which of the four borders a body belongs to, as in MatrixBorders; the
     * ground to none, which is 4. */
    unsigned int
    border(const unsigned int body) const;

    /**
     * The tows along which runs what the body holds: a tow, or the matrix on a
     * border beside them.
     */
    Direction
    runs_along(const unsigned int body) const;

    /**
     * Placement of body number @p body when the angle has grown to @p angle
     * [rad]; at the start of the stage all were at @p start .
     */
    virtual Placement
    move(const std::vector<Placement> &start,
         const unsigned int            body,
         const double                  angle) const = 0;

    /**
     * Place to which an even deformation by @p angle takes what was at
     * @p start , for a first guess [mm]; the stage began with bodies at
     * @p begun .
     */
    virtual Vector3
    place(const std::vector<Placement> &begun,
          const Vector3                &start,
          const double                  angle) const = 0;

    /**
     * Derivative by the angle of the rotation vector of what runs @p along
     * these tows and was at @p start .
     */
    virtual Vector3
    spin(const Vector3 &start, const Direction along) const = 0;

    /** The angle at @p load [rad]. */
    double
    angle_at(const double load) const
    {
      return turning.at(load) * angles.largest_angle;
    }

  private:
    const AngleSettings angles;
    const Way           turning;
  };
} // namespace fiberloom

#endif
