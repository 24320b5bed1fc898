// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_fabric_units_h
#define fiberloom_fabric_units_h

#include <string>

namespace fiberloom
{
  /** The heading of a column or an array, such as "radius[um]". */
  struct Heading
  {
    std::string name;
    bool        is_read = false; // it is one that fibers have
    double      factor  = 1;     // to mm or MPa
  };

  /**
   * Takes @p text apart. A unit in brackets or parentheses may follow the name;
   * of names that are not read it may be any. Throws InputError for a unit that
   * the quantity cannot have.
   */
  Heading
  read_heading(const std::string &text);

  /** Names that are read, with commas between. */
  std::string
  names_read();
} // namespace fiberloom

#endif
