// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/stages/column.h>

#include <algorithm>

namespace fiberloom
{
  std::string
  name_of(const Quantity quantity)
  {
    switch (quantity)
      {
        case Quantity::number:
          return "number";
        case Quantity::strain:
          return "strain";
        case Quantity::fraction:
          return "fraction";
        case Quantity::angle:
          return "angle";
        case Quantity::length:
          return "length";
        case Quantity::force:
          return "force";
        case Quantity::force_per_width:
          return "force per width";
        case Quantity::moment:
          return "moment";
        case Quantity::pressure:
          return "pressure";
        case Quantity::energy:
          return "energy";
      }
    return "";
  }



  std::string
  unit_of(const Quantity quantity)
  {
    switch (quantity)
      {
        case Quantity::angle:
          return "rad";
        case Quantity::length:
          return "mm";
        case Quantity::force:
          return "N";
        case Quantity::force_per_width:
          return "N/mm";
        case Quantity::moment:
        case Quantity::energy:
          return "N.mm";
        case Quantity::pressure:
          return "MPa";
        default:
          return "";
      }
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
