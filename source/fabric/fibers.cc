// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/parameters.h>

#include <fiberloom/fabric/fiber_set.h>

#include <deal.II/base/utilities.h>

#include <Eigen/Geometry>

#include <cmath>
#include <sstream>

namespace fiberloom
{
  namespace
  {
    using Polyline = std::vector<Vector3>;

    Vector3
    read_point(const std::string &text)
    {
      std::istringstream in(text);
      Vector3            point;
      in >> point[0] >> point[1] >> point[2];
      std::string more;
      if (in.fail() || in >> more)
        throw InputError("\"" + text +
                         "\" is no point; allowed: three numbers x y z with "
                         "blanks between");
      return point;
    }

    Polyline
    read_polyline(const std::string &text)
    {
      Polyline line;
      for (const std::string &point :
           dealii::Utilities::split_string_list(text, ','))
        line.push_back(read_point(point));
      if (line.size() < 2)
        throw InputError("it has " + std::to_string(line.size()) +
                         " points; allowed: two or more");
      for (std::size_t i = 1; i < line.size(); ++i)
        if ((line[i] - line[i - 1]).norm() <= 1e-12 * line[i].norm())
          throw InputError("points " + std::to_string(i - 1) + " and " +
                           std::to_string(i) +
                           " are the same; allowed: different points");
      return line;
    }

    /** @p n_nodes points on @p line , at equal distances along it. */
    std::vector<Vector3>
    divide(const Polyline &line, const unsigned int n_nodes)
    {
      std::vector<double> length(1, 0.);
      for (std::size_t i = 1; i < line.size(); ++i)
        length.push_back(length.back() + (line[i] - line[i - 1]).norm());

      std::vector<Vector3> nodes;
      std::size_t          piece = 1;
      for (unsigned int n = 0; n < n_nodes; ++n)
        {
          const double s = length.back() * n / (n_nodes - 1);
          while (piece + 1 < line.size() && s > length[piece])
            ++piece;
          const double part =
            (s - length[piece - 1]) / (length[piece] - length[piece - 1]);
          nodes.push_back((1 - part) * line[piece - 1] + part * line[piece]);
        }
      return nodes;
    }

    /** Tangents at the nodes of the quadratic curves through them. */
    std::vector<Vector3>
    tangents(const std::vector<Vector3> &nodes)
    {
      const std::size_t    last = nodes.size() - 1;
      std::vector<Vector3> tangents(nodes.size());
      tangents[0] = 4 * nodes[1] - 3 * nodes[0] - nodes[2];
      for (std::size_t n = 1; n < last; ++n)
        tangents[n] = nodes[n + 1] - nodes[n - 1];
      tangents[last] = 3 * nodes[last] - 4 * nodes[last - 1] + nodes[last - 2];

      const double step = (nodes[1] - nodes[0]).norm();
      for (Vector3 &tangent : tangents)
        {
          if (!(tangent.norm() > 1e-3 * step))
            throw InputError(
              "it folds back on itself; allowed: bends of less than a half "
              "turn, with enough elements");
          tangent.normalize();
        }
      return tangents;
    }

    /** Across @p tangent , nearest to the axis it is least aligned with. */
    Vector3
    any_direction_across(const Vector3 &tangent)
    {
      Vector3::Index axis;
      tangent.cwiseAbs().minCoeff(&axis);
      const Vector3 direction = Vector3::Unit(axis);
      return (direction - direction.dot(tangent) * tangent).normalized();
    }

    /** Section vectors that do not twist along the line. */
    void
    add_directions(Fiber &fiber)
    {
      const std::vector<Vector3> tangent     = tangents(fiber.centers);
      Vector3                    direction_1 = any_direction_across(tangent[0]);
      for (std::size_t n = 0; n < tangent.size(); ++n)
        {
          if (n > 0)
            direction_1 =
              Eigen::Quaterniond::FromTwoVectors(tangent[n - 1], tangent[n]) *
              direction_1;
          // rounding must not add up
          direction_1 -= direction_1.dot(tangent[n]) * tangent[n];
          direction_1.normalize();
          fiber.directions_1.push_back(direction_1);
          fiber.directions_2.push_back(tangent[n].cross(direction_1));
        }
    }

    Fiber
    build_fiber(const std::string      &polyline,
                const unsigned int      number,
                const FibersParameters &fibers)
    {
      Fiber fiber;
      fiber.tow           = number;
      fiber.radius        = fibers.radius;
      fiber.young_modulus = fibers.young_modulus;
      fiber.poisson_ratio = fibers.poisson_ratio;
      fiber.centers =
        divide(read_polyline(polyline), 2 * fibers.elements_per_fiber + 1);
      add_directions(fiber);
      return fiber;
    }
  } // namespace

  FiberSet
  build_fibers(const Parameters &parameters)
  {
    const FibersParameters &fibers = parameters.fibers;
    FiberSet                set;
    for (const std::string &polyline :
         dealii::Utilities::split_string_list(fibers.polylines, ';'))
      {
        const unsigned int number = set.fibers.size();
        try
          {
            set.fibers.push_back(build_fiber(polyline, number, fibers));
          }
        catch (const InputError &error)
          {
            throw InputError(parameters.where("Fibers/Polylines") +
                             ": line number " + std::to_string(number) + ": " +
                             error.what());
          }
        set.tows.push_back({Tow::Family::none,
                            number,
                            0.,
                            fibers.radius,
                            fibers.radius,
                            {number}});
      }
    return set;
  }
} // namespace fiberloom
