// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/output/section_skin.h>

#include <deal.II/base/numbers.h>

#include <Eigen/Geometry>

#include <cmath>

namespace fiberloom
{
  SectionSkin::SectionSkin(const std::vector<Section> &sections,
                           const unsigned int          n_around)
    : n_around(n_around)
    , n_rings(sections.size())
  {
    points.reserve(n_rings * n_around);
    normals.reserve(n_rings * n_around);
    for (const Section &section : sections)
      {
        const Vector3 tangent = section.tangent();
        const Vector3 side_1  = section.vector_2.cross(tangent);
        const Vector3 side_2  = tangent.cross(section.vector_1);
        for (unsigned int j = 0; j < n_around; ++j)
          {
            const double angle = 2 * dealii::numbers::PI * j / n_around;
            const double c = std::cos(angle), s = std::sin(angle);
            points.push_back(section.center + c * section.vector_1 +
                             s * section.vector_2);
            normals.push_back((c * side_1 + s * side_2).normalized());
          }
      }
  }
} // namespace fiberloom
