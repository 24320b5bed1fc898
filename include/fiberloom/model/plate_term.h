// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_model_plate_term_h
#define fiberloom_model_plate_term_h

#include <fiberloom/contact/contact_state.h>
#include <fiberloom/contact/plate_friction.h>

#include <fiberloom/model/term.h>

namespace fiberloom
{
  struct PlateGroup;
  struct PlateFrictionGroup;

  /** Contact of fibers with the two plates of a stage and its friction; nothing
   * where the stage has none. */
  class PlateTerm : public Term
  {
  public:
    /** Arguments are kept by reference. */
    PlateTerm(const FiberMesh   &mesh,
              const Supports    &supports,
              const BlockLayout &layout)
      : Term(layout)
      , mesh(mesh)
      , supports(supports)
    {}

    /** The plates' body touches any fiber. */
    void
    visit_couplings(const CouplingVisitor &couple) const override;

    void
    add(const State &state, Assembly &sum) const override;

    double
    energy(const State &state) const override;

    /** Friction, if there is some: particles and limits from @p state , slip
     * from what @p history is of, when fibers were at @p q_before . */
    void
    update(const State                     &state,
           const DofVector                 &q_before,
           const std::vector<PlateHistory> &history);

    /**
     * Friction of each section and plate, as update() has set it; empty where
     * there is none.
     */
    const std::vector<PlateFriction> &
    friction() const
    {
      return frictions;
    }

    void
    set_friction(const std::vector<PlateFriction> &friction)
    {
      frictions = friction;
    }

    /** What has to be remembered of an increment that ends at @p state . */
    std::vector<PlateHistory>
    history(const State &state) const;

    /**
     * Energy lost by friction in the increment that ends at @p state [N mm].
     */
    double
    dissipation(const State &state) const override;

  private:
    /** Calls @p visit with contact, heights and group of each section and each
     * plate. */
    template <class Visitor>
    void
    visit_stations(const State &state, const Visitor &visit) const;

    void
    add_friction(const PlateGroup &normal, Assembly &sum) const;

    void
    couple_limit(const PlateGroup         &normal,
                 const PlateFrictionGroup &friction,
                 Assembly                 &sum) const;

    /** Stiffness of the spring that holds the plates' middle [N/mm]. */
    double
    spring() const;

    const FiberMesh           &mesh;
    const Supports            &supports;
    std::vector<PlateFriction> frictions; // of each section and plate
  };
} // namespace fiberloom

#endif
