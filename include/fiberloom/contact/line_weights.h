// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_contact_line_weights_h
#define fiberloom_contact_line_weights_h

#include <fiberloom/beams/fiber_mesh.h>

#include <array>

namespace fiberloom
{
  /**
   * Shape functions of a fiber for contact and their first and second
   * derivatives by the parameter u. Next to the border of two elements their
   * polynomials are blended, so that everything along a fiber is twice
   * continuous and closest points pass nodes smoothly.
   */
  struct LineWeights
  {
    static constexpr unsigned int most_nodes = 5;

    unsigned int                   first_node;
    unsigned int                   n; // nodes: 3, or 5 where blended
    std::array<double, most_nodes> value, first, second;

    /** Beyond an end the last polynomial goes on. */
    LineWeights(const FiberMesh::Line &line, const double u);
  };
} // namespace fiberloom

#endif
