// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_stages_way_h
#define fiberloom_stages_way_h

#include <string>
#include <vector>

namespace fiberloom
{
  class ParameterCatalogue;

  /**
   * The way of a test there and back: from 0 straight to one turning point
   * after the other, which are parts of the largest deformation. The load of
   * the stage grows evenly with the length of the way from 0 to 1.
   */
  class Way
  {
  public:
    /**
     * Entry Way of the section of a test: turning points as parts of @p whole ,
     * such as "the largest strain", from @p lowest to 1.
     */
    static void
    declare(ParameterCatalogue  &catalogue,
            std::vector<double> &turning_points,
            const std::string   &whole,
            const int            lowest);

    /** Throws InputError where a leg leads nowhere; @p where begins it. */
    static void
    check(const std::vector<double> &turning_points, const std::string &where);

    /** @p turning_points as check() allows them; a first one at 0 is where the
     * way begins anyway. */
    explicit Way(const std::vector<double> &turning_points);

    /** Part of the largest deformation at @p load ; exact where it turns. */
    double
    at(const double load) const;

    /** Length of all legs together: from 0 to 1 and back it is 2. */
    double
    length() const
    {
      return whole_length;
    }

    /**
     * End of the leg on which the way goes on from @p load : the load of a
     * turning point, 1 at last.
     */
    double
    next_turn(const double load) const;

    /** Whether a leg ends at @p load . */
    bool
    ends_leg(const double load) const;

    /** The load at which the way is farthest from 0, for the last time. */
    double
    farthest() const;

  private:
    /** Number of the leg that begins at or before @p load . */
    unsigned int
    leg(const double load) const;

    std::vector<double> points, loads; // where legs begin and end
    double              whole_length = 0;
  };
} // namespace fiberloom

#endif
