// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

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
    using HullPoint = boost::geometry::model::d2::point_xy<double>;

    constexpr unsigned int border_points = 48;

    /** A point of the tow's mean line, and axes of the plane across it. */
    struct TowStation
    {
      Vector3 center, tangent, across, up;
    };

    TowStation
    tow_station(const Tow       &tow,
                const FiberMesh &mesh,
                const DofVector &q,
                const double     fraction)
    {
      TowStation station;
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

    /** Where the fiber passes the station's plane, by Newton's method. */
    Section
    section_in_plane(const FiberMesh   &mesh,
                     const DofVector   &q,
                     const unsigned int fiber,
                     const TowStation  &station,
                     const double       fraction)
    {
      const double n = mesh.lines()[fiber].n_elements;
      double       u = fraction * n;
      for (unsigned int i = 0; i < 8; ++i)
        {
          const auto   section = mesh.section(q, mesh.locate(fiber, u));
          const double slope   = section.center_derivative.dot(station.tangent);
          if (slope <= 0)
            break;
          const double step =
            (station.center - section.center).dot(station.tangent) / slope;
          u = std::clamp(u + step, 0., n);
          if (std::abs(step) < 1e-10)
            break;
        }
      return mesh.section(q, mesh.locate(fiber, u));
    }

    /** Appends the fiber's cut, its border drawn along it onto the plane. */
    void
    append_border(std::vector<HullPoint> &points,
                  const Section          &section,
                  const TowStation       &station)
    {
      const Vector3 axis  = section.tangent();
      const double  slant = axis.dot(station.tangent);
      for (unsigned int j = 0; j < border_points; ++j)
        {
          const double angle = 2 * dealii::numbers::PI * j / border_points;
          Vector3      p     = section.center - station.center +
                      std::cos(angle) * section.vector_1 +
                      std::sin(angle) * section.vector_2;
          p -= axis * (p.dot(station.tangent) / slant);
          points.emplace_back(p.dot(station.across), p.dot(station.up));
        }
    }

    double
    hull_area(const std::vector<HullPoint> &points)
    {
      boost::geometry::model::multi_point<HullPoint> cloud;
      cloud.assign(points.begin(), points.end());
      boost::geometry::model::polygon<HullPoint> hull;
      boost::geometry::convex_hull(cloud, hull);
      return boost::geometry::area(hull);
    }

    void
    measure_outline(TowSection &result, const std::vector<HullPoint> &points)
    {
      const auto [left, right] =
        std::minmax_element(points.begin(),
                            points.end(),
                            [](const auto &a, const auto &b) {
                              return a.x() < b.x();
                            });
      const auto [low, high] =
        std::minmax_element(points.begin(),
                            points.end(),
                            [](const auto &a, const auto &b) {
                              return a.y() < b.y();
                            });
      result.width  = right->x() - left->x();
      result.height = high->y() - low->y();
      result.area   = hull_area(points);
    }

    TowSection
    tow_section(const Tow       &tow,
                const FiberMesh &mesh,
                const DofVector &q,
                const double     fraction)
    {
      const TowStation       station = tow_station(tow, mesh, q, fraction);
      std::vector<HullPoint> points;
      double                 fiber_area = 0;
      TowSection             result{};
      result.centroid.setZero();
      for (const unsigned int fiber : tow.fibers)
        {
          const auto section =
            section_in_plane(mesh, q, fiber, station, fraction);
          append_border(points, section, station);

          const double area = dealii::numbers::PI *
                              section.vector_1.cross(section.vector_2).norm() /
                              section.tangent().dot(station.tangent);
          fiber_area += area;
          result.centroid += area * section.center;
        }
      result.centroid /= fiber_area;
      measure_outline(result, points);
      result.packing = fiber_area / result.area;
      return result;
    }
  } // namespace



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
          tow_section(the_tow, mesh, q, double(i) / n_intervals));
        if (i > 0)
          sections[i].abscissa =
            sections[i - 1].abscissa +
            (sections[i].centroid - sections[i - 1].centroid).norm();
      }
    return sections;
  }



  TowAspect
  tow_aspect(const std::vector<TowSection> &sections)
  {
    TowAspect aspect;
    for (std::size_t i = 0; i < sections.size(); ++i)
      {
        const double ratio = sections[i].width / sections[i].height;
        aspect.mean += ratio / sections.size();
        aspect.smallest = i == 0 ? ratio : std::min(aspect.smallest, ratio);
        aspect.largest  = std::max(aspect.largest, ratio);
      }
    return aspect;
  }
} // namespace fiberloom
