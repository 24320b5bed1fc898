// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/contact/proximity_search.h>

#include <CGAL/AABB_segment_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>

namespace fiberloom
{
  namespace
  {
    using Kernel    = CGAL::Simple_cartesian<double>;
    using Segments  = std::vector<Kernel::Segment_3>;
    using Primitive = CGAL::AABB_segment_primitive<Kernel, Segments::iterator>;
    using Tree      = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

    struct Owner
    {
      unsigned int fiber, piece;
    };
  } // namespace



  ProximitySearch::ProximitySearch(const FiberMesh   &mesh,
                                   const double       margin,
                                   const double       skin,
                                   const Pairs        pairs,
                                   const FiberImages *images)
    : mesh(mesh)
    , margin(margin)
    , skin(skin)
    , pairs(pairs)
    , images(images)
  {}



  bool
  ProximitySearch::are_pair(const unsigned int first_fiber,
                            const unsigned int first_piece,
                            const unsigned int second_fiber,
                            const unsigned int second_piece) const
  {
    if (first_fiber == second_fiber)
      return counts(mesh.lines()[first_fiber], first_piece, second_piece);
    return images == nullptr || images->is_pair(first_fiber, second_fiber);
  }



  const std::vector<CandidatePair> &
  ProximitySearch::candidates(const DofVector &q)
  {
    if (!is_needed())
      return found;
    bool valid = searched_at.size() == q.size();
    for (unsigned int n = 0; valid && n < mesh.n_nodes(); ++n)
      valid =
        (q.segment<3>(9 * n) - searched_at.segment<3>(9 * n)).squaredNorm() <
        skin * skin / 4;
    if (!valid)
      search(q);
    return found;
  }



  bool
  ProximitySearch::counts(const FiberMesh::Line &line,
                          const unsigned int     first,
                          const unsigned int     second) const
  {
    const double apart =
      (static_cast<double>(second) - static_cast<double>(first) - 1) *
      line.length / (line.n_nodes() - 1);
    return pairs == Pairs::of_one_too && apart >= 2 * M_PI * line.radius;
  }



  bool
  ProximitySearch::may_touch_itself(const DofVector       &q,
                                    const FiberMesh::Line &line) const
  {
    // The directions of a chain of pieces that turns by less than pi in all lie
    // within half that angle of one of them, along which two points are as far
    // apart as the length between them times its cosine, or farther.
    double  turn = 0, least_stretch = 1;
    Vector3 before = Vector3::Zero();
    for (unsigned int k = 0; k + 1 < line.n_nodes(); ++k)
      {
        const unsigned int node = line.first_node + k;
        const Vector3      piece =
          q.segment<3>(9 * (node + 1)) - q.segment<3>(9 * node);
        least_stretch =
          std::min(least_stretch,
                   piece.norm() * (line.n_nodes() - 1) / line.length);
        if (k > 0)
          turn += std::atan2(before.cross(piece).norm(), before.dot(piece));
        before = piece;
      }
    const double reach = 2 * line.radius + margin + skin;
    return turn >= M_PI ||
           2 * M_PI * line.radius * least_stretch * std::cos(turn / 2) < reach;
  }



  bool
  ProximitySearch::may_find(const DofVector &q) const
  {
    using Box = CGAL::Bbox_3;
    std::vector<Box> boxes;
    for (const auto &line : mesh.lines())
      {
        if (pairs == Pairs::of_one_too && may_touch_itself(q, line))
          return true;
        Vector3 lower = q.segment<3>(9 * line.first_node), upper = lower;
        for (unsigned int k = 1; k < line.n_nodes(); ++k)
          {
            const Vector3 x = q.segment<3>(9 * (line.first_node + k));
            lower           = lower.cwiseMin(x);
            upper           = upper.cwiseMax(x);
          }
        const double reach = line.radius + .5 * (margin + skin);
        lower.array() -= reach;
        upper.array() += reach;
        const Box box(
          lower[0], lower[1], lower[2], upper[0], upper[1], upper[2]);
        for (const Box &other : boxes)
          if (CGAL::do_overlap(box, other))
            return true;
        boxes.push_back(box);
      }
    return false;
  }



  void
  ProximitySearch::search(const DofVector &q)
  {
    searched_at = q;
    found.clear();
    if (!may_find(q))
      return;
    ++searches;
    const auto point = [&](const unsigned int node) {
      return Kernel::Point_3(q[9 * node], q[9 * node + 1], q[9 * node + 2]);
    };

    Segments           segments;
    std::vector<Owner> owners;
    double             largest_radius = 0;
    for (unsigned int f = 0; f < mesh.lines().size(); ++f)
      {
        const auto &line = mesh.lines()[f];
        largest_radius   = std::max(largest_radius, line.radius);
        for (unsigned int k = 0; k + 1 < line.n_nodes(); ++k)
          {
            segments.emplace_back(point(line.first_node + k),
                                  point(line.first_node + k + 1));
            owners.push_back({f, k});
          }
      }

    Tree                            tree(segments.begin(), segments.end());
    std::vector<Tree::Primitive_id> hits;
    for (unsigned int s = 0; s < segments.size(); ++s)
      {
        const auto &[fiber, piece] = owners[s];
        const auto  &line          = mesh.lines()[fiber];
        const double reach = line.radius + largest_radius + margin + skin;
        const auto   box   = segments[s].bbox();
        hits.clear();
        tree.all_intersected_primitives(CGAL::Bbox_3(box.xmin() - reach,
                                                     box.ymin() - reach,
                                                     box.zmin() - reach,
                                                     box.xmax() + reach,
                                                     box.ymax() + reach,
                                                     box.zmax() + reach),
                                        std::back_inserter(hits));
        for (const auto &hit : hits)
          {
            const Owner other = owners[hit - segments.begin()];
            if (other.fiber < fiber ||
                !are_pair(fiber, piece, other.fiber, other.piece))
              continue;
            found.push_back({{{fiber, other.fiber}}, {{piece, other.piece}}});
          }
      }

    std::sort(found.begin(),
              found.end(),
              [](const CandidatePair &a, const CandidatePair &b) {
                return std::tie(a.fibers, a.pieces) <
                       std::tie(b.fibers, b.pieces);
              });
  }



  std::vector<CandidatePair>
  ProximitySearch::meeting(const DofVector &before,
                           const DofVector &after) const
  {
    using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, Owner>;
    std::vector<Box> boxes;
    for (unsigned int f = 0; f < mesh.lines().size(); ++f)
      for (unsigned int k = 0; k + 1 < mesh.lines()[f].n_nodes(); ++k)
        {
          CGAL::Bbox_3 box;
          for (const DofVector *q : {&before, &after})
            for (unsigned int n = 0; n < 2; ++n)
              {
                const Vector3 x =
                  q->segment<3>(9 * (mesh.lines()[f].first_node + k + n));
                box += CGAL::Bbox_3(x[0], x[1], x[2], x[0], x[1], x[2]);
              }
          boxes.emplace_back(box, Owner{f, k});
        }

    std::vector<CandidatePair> pairs;
    CGAL::box_self_intersection_d(
      boxes.begin(), boxes.end(), [&](const Box &a, const Box &b) {
        Owner one = a.info(), other = b.info();
        if (std::tie(other.fiber, other.piece) < std::tie(one.fiber, one.piece))
          std::swap(one, other);
        if (are_pair(one.fiber, one.piece, other.fiber, other.piece))
          pairs.push_back(
            {{{one.fiber, other.fiber}}, {{one.piece, other.piece}}});
      });
    return pairs;
  }
} // namespace fiberloom
