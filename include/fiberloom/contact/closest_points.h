// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_contact_closest_points_h
#define fiberloom_contact_closest_points_h

#include <fiberloom/beams/fiber_mesh.h>

#include <array>
#include <optional>

namespace fiberloom
{
  /** Parameters u on two fibers. */
  using ParameterPair = std::array<double, 2>;

  /**
   * Closest points of the segments a0 a1 and b0 b1, as fractions of them, and
   * their distance [mm].
   */
  struct SegmentDistance
  {
    double s, t, distance;
  };

  /**
   * Where the segments from @p a0 to @p a1 and from @p b0 to @p b1 are closest.
   */
  SegmentDistance
  segment_distance(const Vector3 &a0,
                   const Vector3 &a1,
                   const Vector3 &b0,
                   const Vector3 &b1);

  /**
   * Where the line between two fibers is across both, from @p start . Tangents
   * are those of the sections, so that the point does not hop over the kinks
   * at element ends.
   */
  ParameterPair
  mutual_closest_point(const FiberMesh                   &mesh,
                       const DofVector                   &q,
                       const std::array<unsigned int, 2> &fibers,
                       const ParameterPair               &start);

  /**
   * The same, none where it would lie beyond an end of one of the two fibers:
   * where they part from it, a normal across both makes them closer than they
   * are anywhere.
   */
  std::optional<ParameterPair>
  inner_closest_point(const FiberMesh                   &mesh,
                      const DofVector                   &q,
                      const std::array<unsigned int, 2> &fibers,
                      const ParameterPair               &start);

  /** Where two fibers cross as seen from above, from @p start . */
  ParameterPair
  plan_crossing(const FiberMesh                   &mesh,
                const DofVector                   &q,
                const std::array<unsigned int, 2> &fibers,
                const ParameterPair               &start);

  /**
   * Where the plane across the intermediate geometry (normal: the mean of the
   * two tangents) through the section @p first cuts fiber @p fiber , from
   * @p start . Beyond an end the fiber counts as going on straight; nothing
   * where there is no such place.
   */
  std::optional<double>
  cut_by_plane(const FiberMesh   &mesh,
               const DofVector   &q,
               const Section     &first,
               const unsigned int fiber,
               const double       start);

  /** Unit tangent of the intermediate geometry of two fibers with these unit
   * tangents, which may point opposite ways. */
  Vector3
  mean_direction(const Vector3 &t1, const Vector3 &t2);
} // namespace fiberloom

#endif
