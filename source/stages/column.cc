// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/stages/column.h>

#include <algorithm>

namespace fiberloom
{
  namespace
  {
    /** Name and unit. */
    std::pair<const char *, const char *>
    words_of(const Quantity quantity)
    {
      switch (quantity)
        {
          case Quantity::number:
            return {"number", ""};
          case Quantity::strain:
            return {"strain", ""};
          case Quantity::fraction:
            return {"fraction", ""};
          case Quantity::angle:
            return {"angle", "rad"};
          case Quantity::length:
            return {"length", "mm"};
          case Quantity::area:
            return {"area", "mm2"};
          case Quantity::curvature:
            return {"curvature", "1/mm"};
          case Quantity::areal_weight:
            return {"areal weight", "kg/m2"};
          case Quantity::force:
            return {"force", "N"};
          case Quantity::force_per_width:
            return {"force per width", "N/mm"};
          case Quantity::moment:
            return {"moment", "N.mm"};
          case Quantity::pressure:
            return {"pressure", "MPa"};
          case Quantity::energy:
            return {"energy", "N.mm"};
        }
      return {"", ""};
    }
  } // namespace



  std::string
  name_of(const Quantity quantity)
  {
    return words_of(quantity).first;
  }



  std::string
  unit_of(const Quantity quantity)
  {
    return words_of(quantity).second;
  }



  std::string
  Column::heading() const
  {
    const std::string unit = unit_of(quantity);
    return unit.empty() ? name : name + "[" + unit + "]";
  }



  std::string
  readable(std::string heading)
  {
    std::replace(heading.begin(), heading.end(), '_', ' ');
    if (const auto unit = heading.find('['); unit != std::string::npos)
      heading.insert(unit, " ");
    return heading;
  }
} // namespace fiberloom
