// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/beams/breakage.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace fiberloom
{
  namespace
  {
    // Of two elements that are as overloaded, up to what balance leaves open,
    // the first one breaks, not the one that rounding chooses.
    constexpr double as_overloaded = 1e-4;

    /** Between 0 and 1, the ends excluded. */
    double
    draw(const unsigned int seed,
         const unsigned int fiber,
         const unsigned int element)
    {
      std::seed_seq   seeds{seed, fiber, element};
      std::mt19937_64 generator(seeds);
      // Of its own, as the distributions of the library are not everywhere
      // the same.
      return std::ldexp((generator() >> 11) + .5, -53);
    }

    /** Of an element of length @p length , by what it draws. */
    double
    strength(const StrengthParameters &parameters,
             const double              length,
             const double              drawn)
    {
      return parameters.strength *
             std::pow(-std::log(drawn) * parameters.reference_length / length,
                      1 / parameters.weibull_modulus);
    }

    double
    breaking_strain(const Fiber       &fiber,
                    const unsigned int number,
                    const unsigned int element,
                    const double       length)
    {
      const StrengthParameters &parameters = fiber.strength;
      if (!parameters.can_break())
        return std::numeric_limits<double>::infinity();
      if (parameters.breaking_strain > 0)
        return parameters.breaking_strain;
      if (parameters.weibull_modulus == 0)
        return parameters.strength / fiber.young_modulus;
      return strength(parameters,
                      length,
                      draw(parameters.seed, number, element)) /
             fiber.young_modulus;
    }
  } // namespace



  bool
  can_break(const FiberSet &fibers)
  {
    return std::any_of(fibers.fibers.begin(),
                       fibers.fibers.end(),
                       [](const Fiber &fiber) {
                         return fiber.strength.can_break();
                       });
  }



  Breakage::Breakage(const FiberSet &fibers, const FiberMesh &mesh)
    : mesh(mesh)
  {
    for (unsigned int f = 0; f < mesh.lines().size(); ++f)
      for (unsigned int e = 0; e < mesh.lines()[f].n_elements; ++e)
        strains.push_back(fiberloom::breaking_strain(
          fibers.fibers[f],
          f,
          e,
          mesh.element(mesh.lines()[f].first_element + e).length()));
  }



  std::vector<unsigned int>
  Breakage::advance(const DofVector &q, FiberHistory &history) const
  {
    std::vector<unsigned int> broken;
    for (const FiberMesh::Line &line : mesh.lines())
      {
        double       most = 1, strain = 0;
        unsigned int weakest = 0;
        for (unsigned int e = line.first_element;
             e < line.first_element + line.n_elements;
             ++e)
          {
            if (std::isinf(strains[e]) || history.is_broken(e))
              continue;
            const double here =
              mesh.element(e).largest_strain(mesh.element_dofs(q, e));
            if (here / strains[e] <=
                (strain > 0 ? (1 + as_overloaded) * most : most))
              continue;
            most    = here / strains[e];
            strain  = here;
            weakest = e;
          }
        if (strain == 0)
          continue;
        Break &entry = history.breaks[weakest];
        entry.number = history.breaks.size() - 1;
        entry.strain = strain;
        entry.place  = mesh.section(q, {weakest, 0.}).center;
        broken.push_back(weakest);
      }
    return broken;
  }
} // namespace fiberloom
