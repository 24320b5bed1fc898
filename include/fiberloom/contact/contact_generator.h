// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_contact_contact_generator_h
#define fiberloom_contact_contact_generator_h

#include <fiberloom/contact/contact_element.h>
#include <fiberloom/contact/contact_state.h>
#include <fiberloom/contact/proximity_search.h>
#include <fiberloom/contact/proximity_zones.h>

#include <mpi.h>

#include <optional>
#include <vector>

namespace fiberloom
{
  struct ContactParameters;

  /** How contact is to be generated in a stage, at a load. */
  struct ContactRule
  {
    /**
     * Fibers of crossing tows meet where they cross as seen from above, be
     * they apart or deep in each other (section 4.1).
     */
    bool   from_above      = false;
    double allowed_overlap = 0; // of crossing tows, if from above [mm]
    bool   friction        = false;
    bool   points_follow   = false; // see ContactElement::Points
  };

  /**
   * Section 3.2 of the paper: proximity zones from the candidates of the
   * search, on each an intermediate geometry (the mean of the two centre
   * lines) with stations, at each station the plane across it that cuts both
   * fibers, and the two particles on the sections' borders.
   *
   * A zone is parallel or crossing, by the angle of the fibers and the length
   * on which they are close, with hysteresis. Parallel: stations at material
   * abscissae (k + 1/2) h of the first fiber, closer where the angle asks for
   * it, each with the length it stands for. Crossing: one station at the
   * mutual closest point, with the force integrated over the overlap of
   * straight fibers, and the normal across both fibers, whose sign is kept:
   * the direction from centre to centre turns when fibers slide although the
   * true normal does not. Both are one line penalty.
   * Tangents are r g1 x r g2, which is continuous over element ends.
   *
   * Fibers of a periodic cell are seen with their images, see FiberImages:
   * fibers and nodes of contacts are numbered as those of
   * FiberMesh::with_images(), positions @p q are those of the cell. Zones that
   * differ by whole periods are one, the one whose middle lies on the part of
   * the first fiber that is in the cell.
   *
   * Ranks share the pairs of fibers, then exchange what they found: all have
   * all contacts, as states are on all ranks.
   */
  class ContactGenerator
  {
  public:
    /** References are kept; every rank of @p comm gives the same. */
    ContactGenerator(const FiberSet          &fibers,
                     const FiberMesh         &mesh,
                     const ContactParameters &parameters,
                     const MPI_Comm           comm);

    /**
     * Finds all contact elements where the dofs of the fibers are @p q . Zones
     * in @p state are replaced by the ones found, which inherit from their
     * predecessors; its history is read. @p q_before is the placement of the
     * last accepted increment; only there may stations become fewer.
     * Collective.
     */
    std::vector<ContactElement>
    generate(const DofVector   &q,
             const DofVector   &q_before,
             const ContactRule &rule,
             ContactState      &state);

    /**
     * Sets normals, particles and friction limits mu f* of @p contacts for the
     * placement @p q ; the stations are kept.
     */
    void
    update(std::vector<ContactElement> &contacts,
           const DofVector             &q,
           const DofVector             &q_before,
           const ContactRule           &rule,
           const ContactState          &state) const;

    /** Whether the scene has anything to search for. */
    bool
    searches() const
    {
      return search.is_needed();
    }

    /** Whether fibers may have passed through each other on the way between two
     * placements, see may_pass(). */
    bool
    may_pass(const DofVector &before, const DofVector &after) const;

    /** Searches for candidates done so far. */
    unsigned int
    n_searches() const
    {
      return search.n_searches();
    }

    /** Whether fibers belong to crossing tows. */
    bool
    weaves() const
    {
      return !woven_pairs.empty();
    }

    /** Fibers of crossing tows that lie on the wrong side of each other. */
    unsigned int
    crossings_out_of_order(const DofVector &q) const;

  private:
    /** Does what update() does, at placements of all that contact sees. */
    void
    update_seen(std::vector<ContactElement> &contacts,
                const DofVector             &q,
                const DofVector             &q_before,
                const ContactRule           &rule,
                const ContactState          &state) const;

    /** The part of the first fiber on which a zone has its stations; empty
     * where another zone stands for it. */
    std::array<double, 2>
    counted_part(const ProximityZone &zone) const;

    ContactElement
    new_element(const unsigned int   zone,
                const ParameterPair &u,
                const ContactState  &state) const;

    void
    place_at(ContactElement &contact, const ParameterPair &u) const;

    /**
     * Lets the points of @p contacts follow the fibers where these are not
     * crossed from above.
     */
    void
    let_points_follow(std::vector<ContactElement> &contacts,
                      const DofVector             &q,
                      const ContactState          &state) const;

    /** This rank's part of these; as the next one. */
    void
    add_woven_crossings(const DofVector             &q,
                        const ContactRule           &rule,
                        const ContactState          &before,
                        ContactState                &state,
                        std::vector<ContactElement> &contacts) const;

    void
    add_proximity_zones(const DofVector             &q,
                        const ContactRule           &rule,
                        const ContactState          &before,
                        ContactState                &state,
                        std::vector<ContactElement> &contacts);

    /** The line penalty of @p zone if it is new [N/mm^2]. */
    double
    initial_stiffness(const ContactZone &zone) const;

    /** A zone with what it inherits; it is found as @p zone , with fibers,
     * range and the class that it has if it is new. */
    ContactZone
    successor(ContactZone zone, const ContactState &before) const;

    /**
     * The parameter at which the plane across the intermediate geometry at @p u
     * of the first fiber cuts the second one.
     */
    std::optional<double>
    cut_second(const ProximityZone &zone,
               const double         u,
               const DofVector     &q) const;

    /**
     * Part of a station, @p width of the first fiber's elements long, that has
     * the second fiber in front of it and not what lies beyond its ends;
     * @p cut as cut_second() gives it. Without it, contacts would vanish with
     * force on them where ends slide.
     */
    double
    faced_part(const std::array<unsigned int, 2> &fibers,
               const double                       cut,
               const double                       width) const;

    /**
     * A power of two, as many as a cell of @p cell around @p u needs: fibers
     * at an angle overlap on a length that shrinks with it. The number before,
     * @p now , becomes smaller only where cells may merge and it is much too
     * large, so that stations do not come and go by turns.
     */
    unsigned int
    stations_in_cell(const ProximityZone &zone,
                     const double         u,
                     const double         cell,
                     const DofVector     &q,
                     const unsigned int   now) const;

    void
    add_parallel_stations(const ProximityZone         &proximity,
                          const unsigned int           zone,
                          const DofVector             &q,
                          ContactState                &state,
                          std::vector<ContactElement> &contacts) const;

    void
    set_normal(ContactElement     &contact,
               const DofVector    &q,
               const ContactState &state) const;

    /** Rotation of the normal and the mean direction of the two fibers. */
    Matrix3
    turn(const ContactElement &contact,
         const DofVector      &q_before,
         const DofVector      &q,
         const ContactState   &state) const;

    const FiberMesh         &cell;   // where positions are given
    const FiberSet          &fibers; // with images
    const FiberMesh         &mesh;   // the same
    const ContactParameters &parameters;
    const MPI_Comm           comm;
    ProximitySearch          search;

    std::vector<std::array<unsigned int, 2>> woven_pairs; // fibers that cross
    bool cells_may_merge = true; // where an increment begins
  };
} // namespace fiberloom

#endif
