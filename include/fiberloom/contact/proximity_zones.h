// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_contact_proximity_zones_h
#define fiberloom_contact_proximity_zones_h

#include <fiberloom/contact/closest_points.h>
#include <fiberloom/contact/contact_state.h>
#include <fiberloom/contact/proximity_search.h>

#include <vector>

namespace fiberloom
{
  /** A connected part of two fibers that are closer than the margin. */
  struct ProximityZone
  {
    /** Closest points of two pieces. */
    struct Match
    {
      std::array<unsigned int, 2> pieces;
      ParameterPair               u;
      double                      distance; // of the centre lines [mm]
    };

    std::array<unsigned int, 2> fibers;
    std::vector<Match>          matches; // sorted by pieces

    /** The match with the smallest distance. */
    const Match &
    closest() const;

    /**
     * Parameters u at which the zone begins and ends on fiber number @p side ,
     * 0 or 1.
     */
    std::array<double, 2>
    range(const unsigned int side) const;
  };

  using CandidateIterator = std::vector<CandidatePair>::const_iterator;

  /** Zones in the order of the candidates from @p begin to @p end ; @p margin
   * between surfaces [mm]. */
  std::vector<ProximityZone>
  find_proximity_zones(const FiberMesh        &mesh,
                       const DofVector        &q,
                       const CandidateIterator begin,
                       const CandidateIterator end,
                       const double            margin);

  /** The zones that a zone has come from. */
  struct Predecessors
  {
    std::vector<const ContactZone *> all; // along the first fiber
    const ContactZone *longest = nullptr; // shares the longest part
  };

  /**
   * Those of @p zones (sorted by fibers and range) of the same two fibers that
   * share a part with @p range .
   */
  Predecessors
  find_predecessors(const std::vector<ContactZone>             &zones,
                    const std::array<unsigned int, 2>          &fibers,
                    const std::array<std::array<double, 2>, 2> &range);

  /**
   * What a zone with this @p range on the first fiber inherits, so that zones
   * may split and merge without a change of any contact's stiffness: that of
   * its predecessors, each on its own part. Between two of them it changes at a
   * multiple of @p cell , the length of the part of a station. On predecessors,
   * u is larger by @p shift .
   */
  std::vector<std::pair<double, double>>
  inherited_stiffness(const Predecessors          &before,
                      const std::array<double, 2> &range,
                      const double                 cell,
                      const double                 shift);
} // namespace fiberloom

#endif
