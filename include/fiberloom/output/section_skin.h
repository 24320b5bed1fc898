// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_section_skin_h
#define fiberloom_output_section_skin_h

#include <fiberloom/beams/fiber_mesh.h>

#include <array>
#include <vector>

namespace fiberloom
{
  /**
   * The surface of a deformed fiber: rings of equally many points on the
   * borders of its sections, x0 + r cos(a) g1 + r sin(a) g2. Point j of ring i
   * has index i n_around + j.
   */
  struct SectionSkin
  {
    unsigned int         n_around;
    unsigned int         n_rings;
    std::vector<Vector3> points;
    std::vector<Vector3> normals; // outward

    SectionSkin(const std::vector<Section> &sections,
                const unsigned int          n_around);

    /** Corners of face @p j between the rings @p i and i+1, outward. */
    std::array<unsigned int, 4>
    face(const unsigned int i, const unsigned int j) const
    {
      const unsigned int next = (j + 1) % n_around;
      return {{i * n_around + j,
               i * n_around + next,
               (i + 1) * n_around + next,
               (i + 1) * n_around + j}};
    }
  };
} // namespace fiberloom

#endif
