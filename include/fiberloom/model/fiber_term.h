// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_model_fiber_term_h
#define fiberloom_model_fiber_term_h

#include <fiberloom/model/term.h>

namespace fiberloom
{
  /** The beam elements. */
  class FiberTerm : public Term
  {
  public:
    /** Arguments are kept by reference. @p originals : of the nodes. */
    FiberTerm(const FiberMesh              &mesh,
              const std::vector<NodeImage> &originals,
              const BlockLayout            &layout)
      : Term(layout)
      , mesh(mesh)
      , originals(originals)
    {}

    void
    visit_couplings(const CouplingVisitor &couple) const override;

    void
    add(const State &state, Assembly &sum) const override;

    double
    energy(const State &state) const override;

    double
    rounding() const override;

  private:
    const FiberMesh              &mesh;
    const std::vector<NodeImage> &originals;
  };
} // namespace fiberloom

#endif
