// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/contact/closest_points.h>
#include <fiberloom/contact/passage.h>

#include <algorithm>
#include <array>

namespace fiberloom
{
  namespace
  {
    // Centre lines nearer than this part of both radii are taken to meet.
    constexpr double nearest = .1;

    // Of the time that two pieces need to meet.
    constexpr double safe_part = .9;

    struct MovingPiece
    {
      std::array<Vector3, 2> start, motion; // of its two ends

      MovingPiece(const FiberMesh   &mesh,
                  const unsigned int fiber,
                  const unsigned int piece,
                  const DofVector   &before,
                  const DofVector   &after)
      {
        for (unsigned int n = 0; n < 2; ++n)
          {
            const unsigned int dof =
              9 * (mesh.lines()[fiber].first_node + piece + n);
            start[n]  = before.segment<3>(dof);
            motion[n] = after.segment<3>(dof) - start[n];
          }
      }

      Vector3
      at(const unsigned int end, const double time) const
      {
        return start[end] + time * motion[end];
      }
    };

    bool
    may_meet(const MovingPiece &a, const MovingPiece &b, const double bound)
    {
      double speed = 0;
      for (const Vector3 &one : a.motion)
        for (const Vector3 &other : b.motion)
          speed = std::max(speed, (one - other).norm());
      for (double time = 0; time < 1;)
        {
          const double distance = segment_distance(a.at(0, time),
                                                   a.at(1, time),
                                                   b.at(0, time),
                                                   b.at(1, time))
                                    .distance;
          if (distance < bound)
            return time > 0;
          time += safe_part * distance / std::max(speed, 1e-300);
        }
      return false;
    }
  } // namespace



  bool
  may_pass(const FiberMesh                  &mesh,
           const std::vector<CandidatePair> &pairs,
           const DofVector                  &before,
           const DofVector                  &after)
  {
    const auto &lines = mesh.lines();
    return std::any_of(pairs.begin(), pairs.end(), [&](const auto &pair) {
      const auto piece = [&](const unsigned int s) {
        return MovingPiece(mesh, pair.fibers[s], pair.pieces[s], before, after);
      };
      return may_meet(piece(0),
                      piece(1),
                      nearest * (lines[pair.fibers[0]].radius +
                                 lines[pair.fibers[1]].radius));
    });
  }
} // namespace fiberloom
