// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_fabric_fiber_file_h
#define fiberloom_fabric_fiber_file_h

#include <fiberloom/fabric/curve.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace fiberloom
{
  /** A fiber as it stands in a file. */
  struct FiberPoints
  {
    /** Of the values that a file may give each fiber. */
    static constexpr std::array<const char *, 3> value_names{
      {"radius", "young_modulus", "poisson_ratio"}};

    Polyline                             points; // [mm]
    std::array<std::optional<double>, 3> values; // [mm], [MPa], -
  };

  /**
   * The fibers of @p file , by its name's end a table (.csv) or lines of VTK
   * (.vtp, .vtu). Throws InputError for a file that cannot be read and for
   * values that are no numbers or impossible; points may still coincide.
   */
  std::vector<FiberPoints>
  read_fiber_file(const std::string &file);
} // namespace fiberloom

#endif
