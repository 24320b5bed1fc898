// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_model_composite_terms_h
#define fiberloom_model_composite_terms_h

#include <fiberloom/model/composite.h>
#include <fiberloom/model/term.h>

namespace fiberloom
{
  struct JunctionGroup;

  /** A term of a composite, which needs its matrix or junctions. */
  class CompositeTerm : public Term
  {
  public:
    /** Arguments are kept by reference. */
    CompositeTerm(const Composite &composite, const BlockLayout &layout)
      : Term(layout)
      , composite(composite)
    {}

  protected:
    const Composite &composite;
  };

  /** The cells of a matrix. */
  class CellTerm : public CompositeTerm
  {
  public:
    using CompositeTerm::CompositeTerm;

    void
    visit_couplings(const CouplingVisitor &couple) const override;

    void
    add(const State &state, Assembly &sum) const override;

    double
    energy(const State &state) const override;

    /**
     * What rounding of the positions makes of its forces, through the strain
     * [N].
     */
    double
    rounding() const override;
  };

  /** The junctions of fibers and matrix. */
  class JunctionTerm : public CompositeTerm
  {
  public:
    using CompositeTerm::CompositeTerm;

    void
    visit_couplings(const CouplingVisitor &couple) const override;

    void
    add(const State &state, Assembly &sum) const override;

    double
    energy(const State &state) const override;

    double
    rounding() const override;

  private:
    /**
     * Adds @p group , whose nodes no body holds: its 3 x 3 blocks are diagonal.
     */
    static void
    scatter_diagonals(const JunctionGroup &group, Assembly &sum);
  };
} // namespace fiberloom

#endif
