// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/parameter_catalogue.h>

#include <fiberloom/fabric/usual_values.h>

#include <boost/format.hpp>

#include <string>

namespace fiberloom
{
  namespace
  {
    /** Without what the change of the unit has left in the last digits. */
    double
    rounded(const double value)
    {
      return std::stod((boost::format("%.12g") % value).str());
    }
  } // namespace



  bool
  is_usual(const double value, const UsualRange &range)
  {
    return value == 0 || (value >= range.low && value <= range.high);
  }



  std::string
  explain_unusual(const double value, const UsualRange &range)
  {
    std::string text = exact_text(value) + " " + range.unit +
                       (value < range.low ? " is less" : " is more") +
                       " than " + range.what + " has";
    for (const UsualRange::Unit &unit : range.others)
      if (is_usual(value * unit.factor, range))
        return text + "; if " + unit.name + " are meant, it is " +
               exact_text(rounded(value * unit.factor));
    return text;
  }
} // namespace fiberloom
