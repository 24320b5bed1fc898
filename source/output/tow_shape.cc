// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/output/tow_shape.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace fiberloom
{
  namespace
  {
    constexpr unsigned int stations_per_element = 4, skin_points = 16;

    void
    extend(std::array<Vector3, 2> &box, const Vector3 &point)
    {
      box[0] = box[0].cwiseMin(point);
      box[1] = box[1].cwiseMax(point);
    }

    std::array<Vector3, 2>
    empty_box()
    {
      const double large = std::numeric_limits<double>::max();
      return {{Vector3::Constant(large), Vector3::Constant(-large)}};
    }
  } // namespace



  TowShape::TowShape(const FiberSet    &fibers,
                     const FiberMesh   &mesh,
                     const DofVector   &q,
                     const unsigned int tow)
  {
    const Tow         &the_tow = fibers.tows[tow];
    const unsigned int n =
      stations_per_element * mesh.lines()[the_tow.fibers.front()].n_elements;
    for (unsigned int i = 0; i <= n; ++i)
      {
        Station station;
        station.cut  = cut_tow(the_tow, mesh, q, double(i) / n);
        station.hull = station.cut.hull(skin_points);
        for (std::size_t c = 0; c < station.hull.size(); ++c)
          {
            const auto &a = station.hull[c],
                       &b = station.hull[(c + 1) % station.hull.size()];
            const double        length = std::hypot(b[0] - a[0], b[1] - a[1]);
            const TowCut::Point normal = {
              {(b[1] - a[1]) / length, (a[0] - b[0]) / length}};
            station.borders.push_back(
              {normal, normal[0] * a[0] + normal[1] * a[1]});
          }
        for (const Section &section : station.cut.fibers)
          {
            station.centers.push_back(station.cut.point(section.center));
            station.radii.push_back(
              std::sqrt(section.vector_1.cross(section.vector_2).norm()));
          }
        stations.push_back(station);
      }
  }



  TowShape::Value
  TowShape::value(const std::size_t piece,
                  const double      part,
                  const Vector3    &position) const
  {
    const Station &a = stations[piece], &b = stations[piece + 1];
    const auto     mix = [part](const auto &first, const auto &second) {
      return ((1 - part) * first + part * second).eval();
    };
    const Vector3 away = position - mix(a.cut.center, b.cut.center);
    const double  x    = away.dot(mix(a.cut.across, b.cut.across).normalized()),
                 y     = away.dot(mix(a.cut.up, b.cut.up).normalized());
    const auto outside = [x, y](const Station &station) {
      double most = -std::numeric_limits<double>::max();
      for (const HalfPlane &border : station.borders)
        most =
          std::max(most,
                   border.normal[0] * x + border.normal[1] * y - border.offset);
      return most;
    };

    Value value;
    value.outside   = (1 - part) * outside(a) + part * outside(b);
    value.to_fiber  = std::numeric_limits<double>::max();
    value.direction = mix(a.cut.tangent, b.cut.tangent).normalized();
    for (std::size_t f = 0; f < a.centers.size(); ++f)
      {
        const auto mixed = [part](const double first, const double second) {
          return (1 - part) * first + part * second;
        };
        const double distance =
          std::hypot(x - mixed(a.centers[f][0], b.centers[f][0]),
                     y - mixed(a.centers[f][1], b.centers[f][1]));
        value.to_fiber =
          std::min(value.to_fiber, distance - mixed(a.radii[f], b.radii[f]));
      }
    return value;
  }



  void
  TowShape::visit(const Lattice                            &lattice,
                  const double                              margin,
                  const std::function<void(const Lattice::Index &,
                                           const Value &)> &visit) const
  {
    const std::size_t n_pieces = stations.size() - 1;
    for (std::size_t piece = 0; piece < n_pieces; ++piece)
      {
        const TowCut &first   = stations[piece].cut,
                     &last    = stations[piece + 1].cut;
        auto          limits  = box(piece, piece + 1);
        const Vector3 widened = Vector3::Constant(margin);
        const auto    low     = lattice.nearest(limits[0] - widened),
                   high       = lattice.nearest(limits[1] + widened);
        Lattice::Index i;
        for (i[2] = std::max(low[2], 0);
             i[2] <= std::min(high[2], lattice.n[2] - 1);
             ++i[2])
          for (i[1] = std::max(low[1], 0);
               i[1] <= std::min(high[1], lattice.n[1] - 1);
               ++i[1])
            for (i[0] = std::max(low[0], 0);
                 i[0] <= std::min(high[0], lattice.n[0] - 1);
                 ++i[0])
              {
                const Vector3 x      = lattice.point(i);
                const double  behind = (x - first.center).dot(first.tangent),
                             before  = (last.center - x).dot(last.tangent);
                // Beyond the planes of a piece is another one, or the end.
                if ((behind < 0 && (piece > 0 || behind < -margin)) ||
                    (before <= 0 && (piece + 1 < n_pieces || before < -margin)))
                  continue;
                const double part = behind < 0  ? 0 :
                                    before <= 0 ? 1 :
                                                  behind / (behind + before);
                Value        at   = value(piece, part, x);
                if (piece == 0)
                  at.outside = std::max(at.outside, -behind);
                if (piece + 1 == n_pieces)
                  at.outside = std::max(at.outside, -before);
                if (at.outside < margin)
                  visit(i, at);
              }
      }
  }



  std::array<Vector3, 2>
  TowShape::box(const std::size_t first, const std::size_t last) const
  {
    auto limits = empty_box();
    for (std::size_t s = first; s <= last; ++s)
      for (const TowCut::Point &corner : stations[s].hull)
        extend(limits,
               stations[s].cut.center + corner[0] * stations[s].cut.across +
                 corner[1] * stations[s].cut.up);
    return limits;
  }



  std::array<Vector3, 2>
  TowShape::box() const
  {
    return box(0, stations.size() - 1);
  }



  std::vector<TowShape>
  tow_shapes(const FiberSet &fibers, const FiberMesh &mesh, const DofVector &q)
  {
    std::vector<TowShape> shapes;
    for (unsigned int t = 0; t < fibers.tows.size(); ++t)
      shapes.emplace_back(fibers, mesh, q, t);
    return shapes;
  }



  std::array<Vector3, 2>
  enclosing_box(const std::vector<TowShape> &shapes)
  {
    auto limits = empty_box();
    for (const TowShape &shape : shapes)
      for (const Vector3 &corner : shape.box())
        extend(limits, corner);
    return limits;
  }
} // namespace fiberloom
