// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_contact_zone_class_h
#define fiberloom_contact_zone_class_h

#include <fiberloom/contact/closest_points.h>
#include <fiberloom/contact/proximity_zones.h>

#include <optional>

namespace fiberloom
{
  /**
   * What tells whether two fibers cross in a proximity zone or lie along each
   * other, see ContactGenerator.
   */
  struct ZoneClass
  {
    /**
     * Judges @p zone where the dofs of the fibers are @p q ; @p margin is that
     * of the search [mm].
     */
    ZoneClass(const FiberMesh     &mesh,
              const DofVector     &q,
              const ProximityZone &zone,
              const double         margin);

    /** Whether the fibers cross, in a zone that has no predecessor. */
    bool
    crosses() const;

    /** Whether they still cross, in a zone in which they crossed before. */
    bool
    crosses_still() const;

    /**
     * Whether they cross now, in a zone in which they lay along each other
     * before.
     */
    bool
    crosses_now() const;

    Vector3 t1, t2; // tangents where the fibers are closest

    // an inner one, where tangents are not nearly parallel
    std::optional<ParameterPair> closest;

  private:
    double cosine; // of the angle, without its sign

    /** Length of the zone over that of two straight fibers that touch at the
     * angle. */
    double length;

    /**
     * How fast the two fibers drift apart along the intermediate geometry, over
     * what straight ones at their angle do. At the distance s along both they
     * are ((1 - c) - (k1 + k2) D/2) s^2/D further apart, with the cosine c of
     * the angle, the distance D and the curvatures k towards each other.
     */
    double drift = 1;
  };
} // namespace fiberloom

#endif
