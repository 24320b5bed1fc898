// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_tow_shape_h
#define fiberloom_output_tow_shape_h

#include <fiberloom/output/lattice.h>
#include <fiberloom/output/tow_sections.h>

#include <functional>
#include <vector>

namespace fiberloom
{
  /**
   * A tow as a body: the convex hulls of its fibers' sections, drawn along its
   * mean line and cut off at its ends.
   */
  class TowShape
  {
  public:
    /** What is known at a point in or near the tow. */
    struct Value
    {
      double  outside;   // distance from the body, negative inside [mm]
      double  to_fiber;  // to the skin of the nearest fiber, likewise [mm]
      Vector3 direction; // of the tow, unit
    };

    TowShape(const FiberSet    &fibers,
             const FiberMesh   &mesh,
             const DofVector   &q,
             const unsigned int tow);

    /**
     * Calls @p visit for the points of @p lattice within @p margin of the body
     * and some around, those near the ends of a piece perhaps twice.
     */
    void
    visit(const Lattice &lattice,
          const double   margin,
          const std::function<void(const Lattice::Index &, const Value &)>
            &visit) const;

    /** Lowest and highest coordinates of the body [mm]. */
    std::array<Vector3, 2>
    box() const;

  private:
    struct HalfPlane
    {
      TowCut::Point normal; // unit, outward
      double        offset;
    };

    /** A section of the tow. */
    struct Station
    {
      TowCut                     cut;
      std::vector<TowCut::Point> hull;
      std::vector<HalfPlane>     borders; // of the hull
      std::vector<TowCut::Point> centers; // of the fibers
      std::vector<double>        radii;
    };

    std::vector<Station> stations;

    Value
    value(const std::size_t piece,
          const double      part,
          const Vector3    &position) const;

    std::array<Vector3, 2>
    box(const std::size_t first, const std::size_t last) const;
  };

  /** The shapes of all tows. */
  std::vector<TowShape>
  tow_shapes(const FiberSet &fibers, const FiberMesh &mesh, const DofVector &q);

  /** Lowest and highest coordinates of all [mm]. */
  std::array<Vector3, 2>
  enclosing_box(const std::vector<TowShape> &shapes);
} // namespace fiberloom

#endif
