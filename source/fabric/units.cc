// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>

#include <fiberloom/fabric/units.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace fiberloom
{
  namespace
  {
    using Units = std::vector<std::pair<std::string, double>>;

    // The micro sign and the Greek letter are two characters.
    const Units lengths = {{"mm", 1},
                           {"m", 1e3},
                           {"dm", 100},
                           {"cm", 10},
                           {"um", 1e-3},
                           {"\u00b5m", 1e-3},
                           {"\u03bcm", 1e-3},
                           {"nm", 1e-6}},
                moduli  = {{"MPa", 1},
                           {"N/mm2", 1},
                           {"N/mm^2", 1},
                           {"GPa", 1e3},
                           {"kPa", 1e-3},
                           {"Pa", 1e-6}},
                numbers = {{"-", 1}, {"1", 1}};

    const std::vector<std::pair<std::string, const Units &>> quantities = {
      {"fiber", numbers},
      {"tow", numbers},
      {"family", numbers},
      {"x", lengths},
      {"y", lengths},
      {"z", lengths},
      {"radius", lengths},
      {"young_modulus", moduli},
      {"poisson_ratio", numbers}};

    double
    factor_of(const std::string &unit,
              const Units       &units,
              const std::string &heading)
    {
      std::string allowed;
      for (const auto &[name, factor] : units)
        {
          if (name == unit)
            return factor;
          allowed += (allowed.empty() ? "" : ", ") + name;
        }
      throw InputError("\"" + heading +
                       "\" has an unknown unit; allowed: " + allowed);
    }
  } // namespace



  Heading
  read_heading(const std::string &text)
  {
    const std::size_t bracket = text.find_first_of("[(");
    Heading           heading;
    heading.name        = dealii::Utilities::trim(text.substr(0, bracket));
    const auto quantity = std::find_if(quantities.begin(),
                                       quantities.end(),
                                       [&heading](const auto &known) {
                                         return known.first == heading.name;
                                       });
    heading.is_read     = quantity != quantities.end();
    if (!heading.is_read || bracket == std::string::npos)
      return heading;

    const std::string rest = dealii::Utilities::trim(text.substr(bracket));
    const char        last = rest.front() == '[' ? ']' : ')';
    if (rest.size() < 2 || rest.back() != last)
      throw InputError("\"" + text +
                       "\" has a bracket that does not end; "
                       "allowed: a unit in brackets");
    heading.factor =
      factor_of(dealii::Utilities::trim(rest.substr(1, rest.size() - 2)),
                quantity->second,
                text);
    return heading;
  }



  std::string
  names_read()
  {
    std::string names;
    for (const auto &quantity : quantities)
      names += (names.empty() ? "" : ", ") + quantity.first;
    return names;
  }
} // namespace fiberloom
