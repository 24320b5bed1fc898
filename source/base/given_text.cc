// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/given_text.h>

#include <deal.II/base/utilities.h>

#include <sstream>

namespace fiberloom
{
  std::vector<std::string>
  split_names(const std::string &text, const char separator)
  {
    if (separator != ' ')
      return dealii::Utilities::split_string_list(text, separator);
    std::istringstream       in(text);
    std::vector<std::string> names;
    for (std::string name; in >> name;)
      names.push_back(name);
    return names;
  }



  GivenPoint::GivenPoint(const std::string &text)
    : GivenText(text)
  {
    std::istringstream in(text);
    Vector3            point;
    std::string        more;
    if (in >> point.x() >> point.y() >> point.z() && !(in >> more))
      place = point;
  }
} // namespace fiberloom
