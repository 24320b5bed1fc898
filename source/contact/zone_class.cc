// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/contact/contact_law.h>
#include <fiberloom/contact/zone_class.h>

#include <algorithm>
#include <cmath>

namespace fiberloom
{
  namespace
  {
    // |cos| of the angle of two fibers above which a crossing zone becomes
    // parallel, and below which a parallel one becomes crossing.
    constexpr double parallel_above = .95, crossing_below = .85;

    // Fibers that lie along each other at an angle, as in a strand, are close
    // for longer than straight ones that cross: parallel beyond the second
    // multiple of that length, crossing below the first one.
    constexpr double crossing_length = 1.5, parallel_length = 2;

    // So are fibers that are bent around each other where they cross: parallel
    // if below the first part of what straight ones drift apart is left,
    // crossing above the second one. A mutual closest point then slides far as
    // fibers move by little; where nothing is left, they touch on both sides
    // of it. Near a right angle neither fiber lies along the other.
    constexpr double parallel_drift = .45, crossing_drift = .6;
    constexpr double least_oblique = .25; // |cos| for that

    double
    length_over_crossing(const FiberMesh     &mesh,
                         const ProximityZone &zone,
                         const double         cosine,
                         const double         margin)
    {
      const auto &first  = mesh.lines()[zone.fibers[0]],
                 &second = mesh.lines()[zone.fibers[1]];
      const auto   range = zone.range(0);
      const double piece = first.length / first.n_elements;
      // Straight fibers at the angle a drift apart by 2 tan(a/2) per length.
      const double crossing =
        crossing_spread(cosine, {{first.radius, second.radius}}) *
        std::sqrt(margin);
      return (range[1] - range[0]) * piece / (crossing + piece);
    }

    double
    drift_over_crossing(const FiberMesh                   &mesh,
                        const DofVector                   &q,
                        const std::array<unsigned int, 2> &fibers,
                        const ParameterPair               &u)
    {
      constexpr double half_piece = .25;
      const auto       section = [&](const unsigned int s, const double step) {
        const double end = mesh.lines()[fibers[s]].n_elements;
        return mesh.section(q,
                            mesh.locate(fibers[s],
                                        std::clamp(u[s] + step, 0., end)));
      };
      const Section first = section(0, 0), second = section(1, 0);
      const double  straight =
        1 - std::abs(first.tangent().dot(second.tangent()));
      double bent = 0;
      for (unsigned int s = 0; s < 2; ++s)
        {
          const Section before = section(s, -half_piece),
                        after  = section(s, half_piece);
          const Vector3 other = s == 0 ? Vector3(second.center - first.center) :
                                         Vector3(first.center - second.center);
          bent += .5 * (after.tangent() - before.tangent()).dot(other) /
                  (after.center - before.center).norm();
        }
      return 1 - bent / std::max(straight, 1e-15);
    }
  } // namespace



  ZoneClass::ZoneClass(const FiberMesh     &mesh,
                       const DofVector     &q,
                       const ProximityZone &zone,
                       const double         margin)
  {
    const auto         &fibers = zone.fibers;
    const ParameterPair u      = zone.closest().u;
    t1     = mesh.section(q, mesh.locate(fibers[0], u[0])).tangent();
    t2     = mesh.section(q, mesh.locate(fibers[1], u[1])).tangent();
    cosine = std::abs(t1.dot(t2));
    length = length_over_crossing(mesh, zone, cosine, margin);
    if (cosine >= parallel_above)
      return;
    closest = inner_closest_point(mesh, q, fibers, u);
    if (cosine > least_oblique)
      drift = drift_over_crossing(mesh, q, fibers, u);
  }



  bool
  ZoneClass::crosses() const
  {
    return closest && cosine < .5 * (parallel_above + crossing_below) &&
           length < .5 * (parallel_length + crossing_length) &&
           drift > .5 * (parallel_drift + crossing_drift);
  }



  bool
  ZoneClass::crosses_still() const
  {
    return closest && !(length > parallel_length || drift < parallel_drift);
  }



  bool
  ZoneClass::crosses_now() const
  {
    return crosses_still() && cosine < crossing_below &&
           length < crossing_length && drift > crossing_drift;
  }
} // namespace fiberloom
