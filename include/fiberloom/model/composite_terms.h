// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_model_composite_terms_h
#define fiberloom_model_composite_terms_h

#include <fiberloom/model/composite.h>
#include <fiberloom/model/term.h>

namespace fiberloom
{
  struct JunctionGroup;

  /** The cells of a matrix. */
  class CellTerm : public Term
  {
  public:
    /** Arguments are kept by reference. */
    CellTerm(const Composite &composite, const BlockLayout &layout)
      : composite(composite)
      , layout(layout)
    {}

    void
    visit_couplings(const std::function<void(std::vector<unsigned int>)>
                      &couple) const override;

    void
    add(const State &state, Assembly &sum) const override;

    double
    energy(const State &state) const override;

    /** Through the strain. */
    double
    rounding() const override;

  private:
    const Composite   &composite;
    const BlockLayout &layout;
  };

  /** The junctions of fibers and matrix. */
  class JunctionTerm : public Term
  {
  public:
    /** Arguments are kept by reference. */
    JunctionTerm(const Composite &composite, const BlockLayout &layout)
      : composite(composite)
      , layout(layout)
    {}

    void
    visit_couplings(const std::function<void(std::vector<unsigned int>)>
                      &couple) const override;

    void
    add(const State &state, Assembly &sum) const override;

    double
    energy(const State &state) const override;

    double
    rounding() const override;

  private:
    const Composite   &composite;
    const BlockLayout &layout;

    /** Of a group whose nodes no body holds: its blocks are diagonal. */
    static void
    scatter_diagonals(const JunctionGroup &group, Assembly &sum);
  };
} // namespace fiberloom

#endif
