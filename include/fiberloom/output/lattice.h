// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_lattice_h
#define fiberloom_output_lattice_h

#include <fiberloom/base/vector_types.h>

#include <array>
#include <cmath>

namespace fiberloom
{
  /** Points of a cubic lattice along x, y and z; x runs fastest. */
  struct Lattice
  {
    using Index = std::array<int, 3>;

    Vector3 origin;  // the first point [mm]
    double  spacing; // [mm]
    Index   n;       // points in each direction

    std::size_t
    size() const
    {
      return static_cast<std::size_t>(n[0]) * n[1] * n[2];
    }

    /** Number of the point @p i among all points, x fastest. */
    std::size_t
    number(const Index &i) const
    {
      return i[0] + static_cast<std::size_t>(n[0]) *
                      (i[1] + static_cast<std::size_t>(n[1]) * i[2]);
    }

    /** Position of the point @p i [mm]. */
    Vector3
    point(const Index &i) const
    {
      return origin + spacing * Vector3(i[0], i[1], i[2]);
    }

    /** Whether @p i is one of its points. */
    bool
    has(const Index &i) const
    {
      return i[0] >= 0 && i[1] >= 0 && i[2] >= 0 && i[0] < n[0] &&
             i[1] < n[1] && i[2] < n[2];
    }

    /** The point next to @p position , perhaps none of the lattice. */
    Index
    nearest(const Vector3 &position) const
    {
      Index i;
      for (unsigned int d = 0; d < 3; ++d)
        i[d] =
          static_cast<int>(std::lround((position[d] - origin[d]) / spacing));
      return i;
    }
  };
} // namespace fiberloom

#endif
