// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_fabric_usual_values_h
#define fiberloom_fabric_usual_values_h

#include <string>
#include <vector>

namespace fiberloom
{
  /**
   * Values that fibers or matrices have, widely, and units that may be meant.
   */
  struct UsualRange
  {
    struct Unit
    {
      const char *name;
      double      factor; // to that of the program
    };

    const char       *what;
    double            low, high;
    const char       *unit;
    std::vector<Unit> others;
  };

  /**
   * Whether @p value is in @p range ; also true of 0, which stands for an
   * automatic value.
   */
  bool
  is_usual(const double value, const UsualRange &range);

  /** "0.2 MPa is less than a matrix has; if GPa are meant, it is 200". */
  std::string
  explain_unusual(const double value, const UsualRange &range);
} // namespace fiberloom

#endif
