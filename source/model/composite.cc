// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/model/composite.h>

namespace fiberloom
{
  Composite::Composite(const MatrixState &state, const FiberMesh &fibers)
    : mesh(state.layers,
           state.degree,
           HyperelasticLaw(state.law, state.young_modulus, state.poisson_ratio))
    , n_fiber_nodes(fibers.n_nodes())
  {
    if (!fibers.originals().empty())
      {
        original_nodes = fibers.originals();
        for (NodeImage image : mesh.originals())
          {
            image.node += n_fiber_nodes;
            original_nodes.push_back(image);
          }
      }
    for (const Junction &junction : state.junctions)
      junction_elements.emplace_back(junction, fibers, mesh);
  }



  Vector3
  Composite::junction_force(const unsigned int junction,
                            const DofVector   &q) const
  {
    return junction_elements[junction].force(q, positions(q));
  }
} // namespace fiberloom
