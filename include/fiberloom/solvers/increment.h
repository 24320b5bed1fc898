// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_solvers_increment_h
#define fiberloom_solvers_increment_h

#include <fiberloom/base/statistics.h>

#include <fiberloom/contact/contact_generator.h>

#include <fiberloom/model/system.h>

#include <vector>

namespace fiberloom
{
  struct SolverParameters;

  /** What an increment is asked to satisfy. */
  struct Problem
  {
    const State &before; // the last accepted state
    Targets      targets;
    ContactRule  rule;
    double       least_scale = 0;     // of the residual [N]
    double       load_step   = 0;     // none: not to be cut
    Past         even        = {};    // another one to come from, see Stage
    bool         is_first    = false; // no state was at rest before
    double       near_enough = 0; // of the energy, where a step promises less
    bool is_near = false; // to balance: fibers have hardly any way to go
  };

  /**
   * An increment's equations with the contacts of its present state, and how
   * far they are from balance.
   */
  class Increment
  {
  public:
    /** References are kept. */
    Increment(const FiberMesh        &mesh,
              const SolverParameters &parameters,
              ContactGenerator       &generator,
              System                 &system,
              StageStatistics        &statistics);

    /** Finds contacts anew at @p state , and sets the pattern of the system. */
    void
    generate(State &state, const Problem &problem);

    /**
     * Finds contacts anew as generate() does, but friction keeps its particles,
     * history and limits where a contact is still there.
     */
    void
    regenerate(State &state, const Problem &problem);

    /**
     * Updates normals, particles and friction limits of the present contacts.
     */
    void
    update_normals(const State &state, const Problem &problem);

    /** Assembles residual and tangent of the system at @p state . */
    void
    assemble(const State &state, const Problem &problem);

    /** Assembles the residual alone and returns it over its scale. */
    double
    measure(const State &state, const Problem &problem);

    /**
     * Finds contacts anew at @p state and assembles the residual alone, which
     * is returned over its scale; the matrix is left as it is.
     */
    double
    measure_anew(State &state, const Problem &problem);

    /**
     * The largest unbalanced force of what was assembled last, over scale().
     */
    double
    residual(const Problem &problem) const;

    /** The largest contact force or, without contact, force inside [N]. */
    double
    scale(const Problem &problem) const;

    /** The residual over its scale below which the increment is in balance. */
    double
    tolerance() const;

    /** Contacts between fibers, and friction on plates. */
    struct Contacts
    {
      std::vector<ContactElement> of_fibers;
      std::vector<PlateFriction>  on_plates;
    };

    /** What take_back() needs after other contacts have been found. */
    Contacts
    all_contacts() const
    {
      return {contacts, system.plates().friction()};
    }

    /** Sets contacts to those that all_contacts() gave. */
    void
    take_back(const Contacts &kept)
    {
      contacts = kept.of_fibers;
      system.plates().set_friction(kept.on_plates);
    }

    const FiberMesh            &mesh;
    System                     &system;
    StageStatistics            &statistics;
    std::vector<ContactElement> contacts;

  private:
    void
    update_plates(const State &state, const Problem &problem);

    void
    find_contacts(State &state, const Problem &problem);

    const SolverParameters &parameters;
    ContactGenerator       &generator;
  };
} // namespace fiberloom

#endif
