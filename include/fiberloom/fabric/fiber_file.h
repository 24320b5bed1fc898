// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_fabric_fiber_file_h
#define fiberloom_fabric_fiber_file_h

#include <fiberloom/fabric/curve.h>
#include <fiberloom/fabric/fiber_set.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace fiberloom
{
  /** A fiber as it stands in a file. */
  struct FiberPoints
  {
    /** Names of the values that a file may give each fiber. */
    static constexpr std::array<const char *, 3> value_names{
      {"radius", "young_modulus", "poisson_ratio"}};

    Polyline                             points; // [mm]
    std::array<std::optional<double>, 3> values; // [mm], [MPa], -

    // Both or none, for all fibers of a file: tows follow each other from 0.
    std::optional<std::size_t> tow;
    std::optional<Tow::Family> family;
  };

  /** What a file of fibers holds. */
  struct FiberFile
  {
    // Before anything of the size that a file claims is asked for.
    static constexpr std::uintmax_t most_bytes  = 2000000000;
    static constexpr std::size_t    most_points = 10000000;

    std::vector<FiberPoints> fibers;
    std::vector<std::string> ignored; // columns or arrays that are not read
    std::string              read;    // names of those that are
  };

  /**
   * The fibers of @p file , by its name's end a table (.csv) or lines of VTK
   * (.vtp, .vtu). Throws InputError for a file that cannot be read and for
   * values that are no numbers or impossible; points may still coincide.
   */
  FiberFile
  read_fiber_file(const std::string &file);
} // namespace fiberloom

#endif
