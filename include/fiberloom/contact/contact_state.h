// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_contact_contact_state_h
#define fiberloom_contact_contact_state_h

#include <fiberloom/base/vector_types.h>

#include <boost/serialization/utility.hpp>

#include <array>
#include <utility>
#include <vector>

namespace fiberloom
{
  /**
   * A proximity zone: a part of one fiber that is close to a part of another
   * (or of itself). Zones are found anew at each detection and inherit what is
   * kept here from the zones of the same pair that they overlap.
   */
  struct ContactZone
  {
    std::array<unsigned int, 2> fibers;
    std::array<std::array<double, 2>, 2>
         range;            // parameters u, begin and end, on each fiber
    bool crossing = false; // one station at the mutual closest point
    int  side     = 0;     // crossing: sign of normal . (t_first x t_second)
    std::vector<std::pair<double, double>>
      stiffness; // line penalty [N/mm^2]: up to which u on the first fiber, and
                 // how much; sorted, the last also beyond its end
    std::vector<std::pair<int, unsigned int>>
      divided; // parallel: cells of several stations, and how many; sorted

    /** The entry of the stiffness that holds at @p u on the first fiber. */
    unsigned int
    part_at(const double u) const
    {
      unsigned int part = 0;
      while (part + 1 < stiffness.size() && u >= stiffness[part].first)
        ++part;
      return part;
    }

    template <class Archive>
    void
    serialize(Archive &ar, const unsigned int)
    {
      for (unsigned int s = 0; s < 2; ++s)
        ar &fibers[s] & range[s][0] & range[s][1];
      ar &crossing &side &stiffness &divided;
    }
  };

  /** Reversible slip of a station at the end of the last accepted increment. */
  struct FrictionHistory
  {
    std::array<unsigned int, 2> fibers;
    std::array<double, 2>       u;
    Vector3                     slip;

    template <class Archive>
    void
    serialize(Archive &ar, const unsigned int)
    {
      for (unsigned int s = 0; s < 2; ++s)
        ar &fibers[s] & u[s];
      for (unsigned int i = 0; i < 3; ++i)
        ar &slip[i];
    }
  };

  /**
   * Reversible slip of a section that touches a plate, at the end of the last
   * accepted increment.
   */
  struct PlateHistory
  {
    unsigned int          fiber;
    double                u;
    bool                  upper; // plate
    std::array<double, 2> slip;  // in the plane [mm]

    template <class Archive>
    void
    serialize(Archive &ar, const unsigned int)
    {
      ar &fiber &u &upper &slip[0] & slip[1];
    }
  };

  /**
   * All that contact remembers; part of the state. Each list is sorted by
   * fibers, then by u.
   */
  struct ContactState
  {
    std::vector<ContactZone>     zones;
    std::vector<FrictionHistory> history; // empty without friction
    std::vector<PlateHistory>    plates;  // likewise

    template <class Archive>
    void
    serialize(Archive &ar, const unsigned int)
    {
      ar &zones &history &plates;
    }
  };
} // namespace fiberloom

#endif
