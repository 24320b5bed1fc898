// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_beams_fiber_history_h
#define fiberloom_beams_fiber_history_h

#include <fiberloom/base/vector_types.h>

#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>

#include <map>
#include <string>

namespace fiberloom
{
  /** When, where and by what an element of a fiber broke. */
  struct Break
  {
    unsigned int number    = 0; // of the break, from 0
    std::string  stage     = {};
    unsigned int increment = 0;
    double       load      = 0;
    double       strain    = 0;               // the largest in its sections
    Vector3      place     = Vector3::Zero(); // of the element's middle [mm]

    template <class Archive>
    void
    serialize(Archive &ar, const unsigned int)
    {
      ar &number &stage &increment &load &strain;
      for (unsigned int i = 0; i < 3; ++i)
        ar &place[i];
    }
  };

  /** All that the materials of fibers remember; part of the state. */
  struct FiberHistory
  {
    std::map<unsigned int, Break> breaks; // by element of the mesh

    bool
    is_broken(const unsigned int element) const
    {
      return breaks.count(element) > 0;
    }

    template <class Archive>
    void
    serialize(Archive &ar, const unsigned int)
    {
      ar &breaks;
    }
  };
} // namespace fiberloom

#endif
