// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_model_term_h
#define fiberloom_model_term_h

#include <fiberloom/model/assembly.h>

#include <functional>
#include <limits>
#include <vector>

namespace fiberloom
{
  /** Called with the blocks of each group of nodes; may add others. */
  using CouplingVisitor = std::function<void(std::vector<unsigned int> &)>;

  /** A part of the potential of a system, as of its fibers or of plates. */
  class Term
  {
  public:
    /** @p layout is kept by reference. */
    explicit Term(const BlockLayout &layout)
      : layout(layout)
    {}

    virtual ~Term() = default;

    /** Calls @p couple with the blocks of each group of nodes that it couples,
     * of all ranks. */
    virtual void
    visit_couplings(const CouplingVisitor &couple) const = 0;

    /**
     * Adds gradient and, if @p sum asks for it, Hessian of the term at
     * @p state , as far as they touch owned blocks.
     */
    virtual void
    add(const State &state, Assembly &sum) const = 0;

    /** This rank's part of the term's energy at @p state [N mm]. */
    virtual double
    energy(const State &state) const = 0;

    /**
     * Energy lost in the increment that ends at @p state [N mm]: on any rank
     * that of all.
     */
    virtual double
    dissipation(const State & /*state*/) const
    {
      return 0;
    }

    /** What rounding of the positions makes of its forces [N]. */
    virtual double
    rounding() const
    {
      return 0;
    }

  protected:
    /** Whether what begins at @p node counts in this rank's part. */
    bool
    owns(const unsigned int node) const
    {
      return layout.local_block(node) >= 0;
    }

    const BlockLayout &layout;

    // Of a force, over stiffness and place.
    static constexpr double rounding_errors =
      10 * std::numeric_limits<double>::epsilon();
  };
} // namespace fiberloom

#endif
