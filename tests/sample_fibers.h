// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_tests_sample_fibers_h
#define fiberloom_tests_sample_fibers_h

#include <fiberloom/fabric/fiber_set.h>

#include <Eigen/Geometry>

/**
 * A fiber of radius 1 and modulus 1 along @p curve , a function of [0, 1], its
 * first section vector as near to @p first as it can be.
 */
template <class Curve>
fiberloom::Fiber
curved_fiber(const Curve              &curve,
             const unsigned int        n_elements,
             const fiberloom::Vector3 &first,
             const double              poisson_ratio = .3)
{
  using fiberloom::Vector3;
  fiberloom::Fiber fiber{0, 1., 1., poisson_ratio, {}, {}, {}};
  for (unsigned int n = 0; n <= 2 * n_elements; ++n)
    {
      const double  t       = n / (2. * n_elements);
      const Vector3 tangent = (curve(t + 1e-5) - curve(t - 1e-5)).normalized();
      const Vector3 g1 = (first - tangent * tangent.dot(first)).normalized();
      fiber.centers.push_back(curve(t));
      fiber.directions_1.push_back(g1);
      fiber.directions_2.push_back(tangent.cross(g1));
    }
  return fiber;
}

inline fiberloom::Fiber
straight_fiber(const fiberloom::Vector3 &start,
               const fiberloom::Vector3 &end,
               const unsigned int        n_elements,
               const double              poisson_ratio = .3)
{
  const auto line = [&](const double t) -> fiberloom::Vector3 {
    return start + t * (end - start);
  };
  const bool upright = std::abs((end - start).normalized().z()) > .9;
  return curved_fiber(line,
                      n_elements,
                      upright ? fiberloom::Vector3(1, 0, 0) :
                                fiberloom::Vector3(0, 0, 1),
                      poisson_ratio);
}

/** Each fiber a tow of its own. */
inline fiberloom::FiberSet
loose_fibers(const std::vector<fiberloom::Fiber> &fibers)
{
  fiberloom::FiberSet set{fibers, {}, {}};
  for (unsigned int f = 0; f < fibers.size(); ++f)
    {
      set.fibers[f].tow = f;
      set.tows.push_back({fiberloom::Tow::Family::none, f, 0., 1., 1., {f}});
    }
  return set;
}

#endif
