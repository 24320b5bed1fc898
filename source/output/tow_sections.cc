// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/output/fiber_samples.h>
#include <fiberloom/output/tow_sections.h>

#include <deal.II/base/numbers.h>

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/multi_point.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace fiberloom
{
  namespace
  {
    constexpr unsigned int border_points = 48;

    /** Center and axes of the plane. */
    TowCut
    tow_station(const Tow       &tow,
                const FiberMesh &mesh,
                const DofVector &q,
                const double     fraction)
    {
      TowCut station;
      station.center.setZero();
      station.tangent.setZero();
      for (const unsigned int fiber : tow.fibers)
        {
          const double n = mesh.lines()[fiber].n_elements;
          const auto   section =
            mesh.section(q, mesh.locate(fiber, fraction * n));
          station.center += section.center / tow.fibers.size();
          station.tangent += section.tangent();
        }
      station.tangent.normalize();

      const Vector3 vertical = std::abs(station.tangent[2]) < .95 ?
                                 Vector3::UnitZ() :
                                 Vector3::UnitY();
      station.across         = vertical.cross(station.tangent).normalized();
      station.up             = station.tangent.cross(station.across);
      return station;
    }

    /** Corners of the borders of the fibers' cuts, drawn along each fiber onto
     * the plane. */
    std::vector<TowCut::Point>
    borders(const TowCut &cut, const unsigned int n_around)
    {
      std::vector<TowCut::Point> points;
      for (const Section &section : cut.fibers)
        {
          const Vector3 axis  = section.tangent();
          const double  slant = axis.dot(cut.tangent);
          for (unsigned int j = 0; j < n_around; ++j)
            {
              const double  angle = 2 * dealii::numbers::PI * j / n_around;
              const Vector3 p     = section.center +
                                std::cos(angle) * section.vector_1 +
                                std::sin(angle) * section.vector_2;
              points.push_back(cut.point(
                p - axis * ((p - cut.center).dot(cut.tangent) / slant)));
            }
        }
      return points;
    }

    double
    extent(const std::vector<TowCut::Point> &points, const unsigned int d)
    {
      const auto [low, high] =
        std::minmax_element(points.begin(),
                            points.end(),
                            [d](const auto &a, const auto &b) {
                              return a[d] < b[d];
                            });
      return (*high)[d] - (*low)[d];
    }

    TowSection
    tow_section(const TowCut &cut)
    {
      TowSection result{};
      result.centroid.setZero();
      double fiber_area = 0;
      for (std::size_t f = 0; f < cut.fibers.size(); ++f)
        {
          fiber_area += cut.areas[f];
          result.centroid += cut.areas[f] * cut.fibers[f].center;
        }
      result.centroid /= fiber_area;
      const auto hull = cut.hull(border_points);
      result.width    = extent(hull, 0);
      result.height   = extent(hull, 1);
      result.area     = polygon_area(hull);
      result.packing  = fiber_area / result.area;
      return result;
    }
  } // namespace



  TowCut::Point
  TowCut::point(const Vector3 &position) const
  {
    return {{(position - center).dot(across), (position - center).dot(up)}};
  }



  std::vector<TowCut::Point>
  TowCut::hull(const unsigned int n_around) const
  {
    using HullPoint = boost::geometry::model::d2::point_xy<double>;
    boost::geometry::model::multi_point<HullPoint> cloud;
    for (const Point &p : borders(*this, n_around))
      cloud.emplace_back(p[0], p[1]);
    boost::geometry::model::polygon<HullPoint, false, false> hull;
    boost::geometry::convex_hull(cloud, hull);
    std::vector<Point> corners;
    for (const HullPoint &p : hull.outer())
      corners.push_back({{p.x(), p.y()}});
    return corners;
  }



  TowCut
  cut_tow(const Tow       &tow,
          const FiberMesh &mesh,
          const DofVector &q,
          const double     fraction)
  {
    TowCut cut = tow_station(tow, mesh, q, fraction);
    for (const unsigned int fiber : tow.fibers)
      {
        const double u =
          parameter_on_plane(mesh,
                             q,
                             fiber,
                             fraction * mesh.lines()[fiber].n_elements,
                             {cut.tangent, cut.center});
        const auto section = mesh.section(q, mesh.locate(fiber, u));
        cut.fibers.push_back(section);
        cut.areas.push_back(dealii::numbers::PI *
                            section.vector_1.cross(section.vector_2).norm() /
                            section.tangent().dot(cut.tangent));
      }
    return cut;
  }



  double
  polygon_area(const std::vector<TowCut::Point> &polygon)
  {
    double twice = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
      {
        const auto &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        twice += a[0] * b[1] - a[1] * b[0];
      }
    return .5 * twice;
  }



  std::vector<TowSection>
  tow_sections(const FiberSet    &fibers,
               const FiberMesh   &mesh,
               const DofVector   &q,
               const unsigned int tow)
  {
    const Tow         &the_tow = fibers.tows[tow];
    const unsigned int n_intervals =
      2 * mesh.lines()[the_tow.fibers.front()].n_elements;

    std::vector<TowSection> sections;
    for (unsigned int i = 0; i <= n_intervals; ++i)
      {
        sections.push_back(
          tow_section(cut_tow(the_tow, mesh, q, double(i) / n_intervals)));
        if (i > 0)
          sections[i].abscissa =
            sections[i - 1].abscissa +
            (sections[i].centroid - sections[i - 1].centroid).norm();
      }
    return sections;
  }
} // namespace fiberloom
