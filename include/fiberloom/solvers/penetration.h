// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_solvers_penetration_h
#define fiberloom_solvers_penetration_h

#include <fiberloom/beams/fiber_mesh.h>

#include <fiberloom/contact/contact_element.h>
#include <fiberloom/contact/contact_state.h>

#include <fiberloom/model/motion.h>

#include <vector>

namespace fiberloom
{
  struct ContactParameters;

  /**
   * How deep fibers are in each other, over their radius, and how stiff their
   * zones have to be for that; section 2.6 of the theory.
   */
  class Penetration
  {
  public:
    /** References are kept. */
    Penetration(const FiberMesh         &mesh,
                const ContactParameters &parameters,
                const Motion            &motion);

    /** The largest penetration of @p contacts over the radius. */
    double
    largest(const std::vector<ContactElement> &contacts) const;

    /** From here on what was not avoided at @p contacts is no throw. */
    void
    remember(const std::vector<ContactElement> &contacts);

    /** Whether a step has thrown fibers deep into each other since. */
    bool
    is_thrown(const std::vector<ContactElement> &contacts) const;

    /**
     * Whether some of @p contacts are so deep that zones have to be stiffened.
     */
    bool
    needs_stiffening(const std::vector<ContactElement> &contacts) const;

    /**
     * Stiffens those @p zones of @p contacts that are too soft; whether there
     * were any.
     */
    bool
    stiffen(const std::vector<ContactElement> &contacts,
            std::vector<ContactZone>          &zones) const;

  private:
    /** Whether one body holds both fibers next to where they touch and the
     * penalty is as stiff as their sections: the overlap left there is what the
     * body asks of them. */
    bool
    is_imposed(const ContactElement &contact) const;

    /** The largest that is not imposed. */
    double
    avoidable(const std::vector<ContactElement> &contacts) const;

    const FiberMesh         &mesh;
    const ContactParameters &parameters;
    const Motion            &motion;
    double                   deepest = 0; // that is no throw
  };
} // namespace fiberloom

#endif
