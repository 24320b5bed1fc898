// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_contact_proximity_search_h
#define fiberloom_contact_proximity_search_h

#include <fiberloom/beams/fiber_mesh.h>

#include <array>
#include <vector>

namespace fiberloom
{
  /**
   * Two straight pieces of centre lines, each from one node to the next, that
   * may be close. Piece k of a fiber spans u = k/2 .. (k+1)/2.
   */
  struct CandidatePair
  {
    std::array<unsigned int, 2> fibers; // first <= second
    std::array<unsigned int, 2> pieces; // within the fiber
  };

  /**
   * Finds the pieces of fibers whose surfaces are closer than a margin, by a
   * CGAL AABB tree over all pieces. The tree is asked with an additional skin
   * and its answer kept until some node has moved by half of that skin, so
   * that calls between small moves cost one pass over the nodes.
   */
  class ProximitySearch
  {
  public:
    /** Which pieces are pairs. */
    enum class Pairs
    {
      of_two_fibers,
      of_one_too // with themselves
    };

    /**
     * @p margin and @p skin in mm; @p images says which pairs count where
     * @p mesh are the images of a cell's fibers.
     */
    ProximitySearch(const FiberMesh   &mesh,
                    const double       margin,
                    const double       skin,
                    const Pairs        pairs,
                    const FiberImages *images = nullptr);

    /** Whether two pieces could ever be a pair; else nothing is searched. */
    bool
    is_needed() const
    {
      return pairs == Pairs::of_one_too || mesh.lines().size() > 1;
    }

    /**
     * Candidates where the dofs of the fibers are @p q : all pairs closer than
     * the margin, and some that are not; sorted. Pieces of one fiber count, if
     * they do at all, when they are further apart along it than its
     * circumference.
     */
    const std::vector<CandidatePair> &
    candidates(const DofVector &q);

    /**
     * Pairs of pieces whose boxes overlap at some time while all nodes go
     * straight from @p before to @p after .
     */
    std::vector<CandidatePair>
    meeting(const DofVector &before, const DofVector &after) const;

    /** Number of trees that were built and asked so far. */
    unsigned int
    n_searches() const
    {
      return searches;
    }

  private:
    void
    search(const DofVector &q);

    /** False where the boxes around all fibers are apart and no fiber turns
     * far enough to come back to itself: then there is nothing to find. */
    bool
    may_find(const DofVector &q) const;

    /** Whether two pieces are a pair. */
    bool
    are_pair(const unsigned int first_fiber,
             const unsigned int first_piece,
             const unsigned int second_fiber,
             const unsigned int second_piece) const;

    /** Whether two pieces of one fiber are far enough apart along it. */
    bool
    counts(const FiberMesh::Line &line,
           const unsigned int     first,
           const unsigned int     second) const;

    bool
    may_touch_itself(const DofVector &q, const FiberMesh::Line &line) const;

    const FiberMesh           &mesh;
    const double               margin;
    const double               skin;
    const Pairs                pairs;
    const FiberImages         *images; // or null
    unsigned int               searches = 0;
    DofVector                  searched_at;
    std::vector<CandidatePair> found;
  };
} // namespace fiberloom

#endif
