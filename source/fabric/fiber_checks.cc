// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/parameter_catalogue.h>

#include <fiberloom/fabric/fiber_checks.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace fiberloom
{
  namespace
  {
    // What lies beyond is no fiber, and its powers no numbers [mm], [MPa].
    constexpr double thinnest = 1e-9, softest = 1e-12, stiffest = 1e15;

    template <class Nodes>
    void
    check_bends_of(const Nodes &nodes, const double radius)
    {
      for (std::size_t n = 1; n < nodes.centers.size(); ++n)
        {
          const Vector3 before =
            nodes.directions_1[n - 1].cross(nodes.directions_2[n - 1]);
          const Vector3 after =
            nodes.directions_1[n].cross(nodes.directions_2[n]);
          const double angle =
            std::atan2(before.cross(after).norm(), before.dot(after));
          const double chord = (nodes.centers[n] - nodes.centers[n - 1]).norm();
          if (radius * angle >= chord)
            throw InputError("it bends with a radius of " +
                             exact_text(chord / angle) + " between nodes " +
                             std::to_string(n - 1) + " and " +
                             std::to_string(n) +
                             "; allowed: more than the "
                             "fiber's own radius, " +
                             exact_text(radius));
        }
    }

    const std::vector<Vector3> &
    initial_centers(const Fiber &fiber)
    {
      return fiber.initial ? fiber.initial->centers : fiber.centers;
    }

    using Box = Eigen::AlignedBox3d;

    Box
    box_around(const Fiber &fiber)
    {
      Box box;
      for (const Vector3 &center : initial_centers(fiber))
        box.extend(center);
      return box;
    }

    double
    distance_to(const std::vector<Vector3> &line, const Vector3 &point)
    {
      double least = 1e300;
      for (std::size_t n = 1; n < line.size(); ++n)
        {
          const Vector3 piece = line[n] - line[n - 1];
          const double  part =
            std::clamp(piece.dot(point - line[n - 1]) / piece.squaredNorm(),
                       0.,
                       1.);
          least =
            std::min(least, (line[n - 1] + part * piece - point).squaredNorm());
        }
      return std::sqrt(least);
    }

    /**
     * Whether nodes, visited in their order, are closer than @p limit to a
     * line. Distances fall no faster than one goes: nodes that cannot be near
     * are not compared with all pieces of the line.
     */
    class Nearness
    {
    public:
      Nearness(const std::vector<Vector3> &nodes,
               const std::vector<Vector3> &line,
               const double                limit)
        : nodes(nodes)
        , line(line)
        , limit(limit)
      {}

      bool
      at(const std::size_t n)
      {
        if (n > 0)
          least -= (nodes[n] - nodes[n - 1]).norm();
        if (least <= limit)
          least = distance_to(line, nodes[n]);
        return least < limit;
      }

    private:
      const std::vector<Vector3> &nodes, &line;
      const double                limit;
      double                      least = 0; // of the distance
    };

    bool
    lie_in_each_other(const Fiber &first, const Fiber &second)
    {
      const double radius = std::min(first.radius, second.radius);
      const auto  &nodes  = initial_centers(first),
                 &line    = initial_centers(second);
      Nearness nearness(nodes, line, .1 * radius);
      double   shared = 0;
      bool     inside = nearness.at(0);
      bool     all    = inside;
      for (std::size_t n = 1; n < nodes.size(); ++n)
        {
          const bool before = inside;
          inside            = nearness.at(n);
          all               = all && inside;
          shared =
            before && inside ? shared + (nodes[n] - nodes[n - 1]).norm() : 0;
          if (shared > 2 * radius)
            return true;
        }
      return all;
    }
  } // namespace



  void
  check_place(const Vector3 &point, const std::string &name)
  {
    if (!(point.cwiseAbs().maxCoeff() <= farthest))
      throw InputError(name + " is farther than " + exact_text(farthest) +
                       " mm from the origin; allowed: nearer points");
  }



  void
  check_proportions(const Fiber &fiber)
  {
    double length = 0;
    for (std::size_t n = 0; n < fiber.centers.size(); ++n)
      {
        check_place(fiber.centers[n], "node " + std::to_string(n));
        if (n > 0)
          length += (fiber.centers[n] - fiber.centers[n - 1]).norm();
      }
    if (!(fiber.radius <= length))
      throw InputError("its radius, " + exact_text(fiber.radius) +
                       ", is larger than its length, " + exact_text(length) +
                       "; allowed: a smaller radius");
    if (!(fiber.radius >= thinnest * length))
      throw InputError("its radius, " + exact_text(fiber.radius) +
                       ", is lost beside its length, " + exact_text(length) +
                       "; allowed: at least " + exact_text(thinnest) +
                       " times the length");
    if (!(fiber.young_modulus >= softest && fiber.young_modulus <= stiffest))
      throw InputError("its Young modulus, " + exact_text(fiber.young_modulus) +
                       ", is that of no fiber; allowed: from " +
                       exact_text(softest) + " to " + exact_text(stiffest));
  }



  void
  check_bends(const Fiber &fiber)
  {
    check_bends_of(fiber, fiber.radius);
    if (fiber.initial)
      check_bends_of(*fiber.initial, fiber.radius);
  }



  void
  check_apart(const std::vector<Fiber> &fibers)
  {
    std::vector<Box> boxes;
    for (const Fiber &fiber : fibers)
      boxes.push_back(box_around(fiber));
    for (std::size_t i = 0; i < fibers.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (boxes[i].exteriorDistance(boxes[j]) <
              .1 * std::min(fibers[i].radius, fibers[j].radius) &&
            (lie_in_each_other(fibers[i], fibers[j]) ||
             lie_in_each_other(fibers[j], fibers[i])))
          throw InputError("fibers " + std::to_string(j) + " and " +
                           std::to_string(i) +
                           " lie in each other; allowed: axes at least a "
                           "tenth of the radius apart, but for crossings");
  }
} // namespace fiberloom
