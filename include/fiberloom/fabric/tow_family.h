// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_fabric_tow_family_h
#define fiberloom_fabric_tow_family_h

#include <fiberloom/fabric/fiber_set.h>

#include <optional>
#include <string>

namespace fiberloom
{
  /** The name of @p family as it stands in files: warp, fill or none. */
  inline std::string
  family_name(const Tow::Family family)
  {
    switch (family)
      {
        case Tow::Family::warp:
          return "warp";
        case Tow::Family::fill:
          return "fill";
        default:
          return "none";
      }
  }

  /** The family that has this name; empty for any other text. */
  inline std::optional<Tow::Family>
  family_of_name(const std::string &name)
  {
    for (const auto family :
         {Tow::Family::warp, Tow::Family::fill, Tow::Family::none})
      if (name == family_name(family))
        return family;
    return {};
  }
} // namespace fiberloom

#endif
