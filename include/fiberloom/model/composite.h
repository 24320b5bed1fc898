// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_model_composite_h
#define fiberloom_model_composite_h

#include <fiberloom/base/choices.h>

#include <fiberloom/coupling/junction.h>

#include <boost/serialization/string.hpp>

#include <string>
#include <vector>

namespace fiberloom
{
  /** What the layers of matrix are, and how they hang on the fibers; all that a
   * checkpoint needs to build them again. */
  struct MatrixState
  {
    LayerGeometry         layers;
    unsigned int          degree        = 1;
    MatrixLaw             law           = MatrixLaw::neo_hooke;
    double                young_modulus = 0; // [MPa]
    double                poisson_ratio = 0;
    std::vector<Junction> junctions;

    bool
    is_empty() const
    {
      return layers.blocks.empty();
    }

    template <class Archive>
    void
    serialize(Archive &ar, const unsigned int)
    {
      // By its name, so that a new one may be put between others.
      std::string name = is_empty() ? "" : name_of(law);
      ar &layers &degree &name &young_modulus &poisson_ratio &junctions;
      if (!name.empty())
        law = choice_of<MatrixLaw>(name);
    }
  };

  /** The matrix of a state with its junctions, ready to be assembled. */
  class Composite
  {
  public:
    /** @p fibers has to outlive this. */
    Composite(const MatrixState &state, const FiberMesh &fibers);

    const MatrixMesh &
    matrix() const
    {
      return mesh;
    }

    const std::vector<JunctionElement> &
    junctions() const
    {
      return junction_elements;
    }

    /** The part of the dofs @p q of a state that belongs to the matrix. */
    auto
    positions(const DofVector &q) const
    {
      return q.tail(3 * mesh.n_nodes());
    }

    /** Where the numbers of the matrix's nodes start among all nodes. */
    unsigned int
    first_node() const
    {
      return n_fiber_nodes;
    }

    /** What each node of fibers and matrix is the image of; empty without a
     * cell. */
    const std::vector<NodeImage> &
    originals() const
    {
      return original_nodes;
    }

    /**
     * Force of junction number @p junction on its fiber [N] at the dofs @p q of
     * a state.
     */
    Vector3
    junction_force(const unsigned int junction, const DofVector &q) const;

  private:
    MatrixMesh                   mesh;
    std::vector<JunctionElement> junction_elements;
    unsigned int                 n_fiber_nodes;
    std::vector<NodeImage>       original_nodes;
  };
} // namespace fiberloom

#endif
