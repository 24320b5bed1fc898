// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/vector_function.h>

#include <deal.II/base/point.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace fiberloom
{
  namespace
  {
    // Fine enough for hundreds of turns.
    constexpr unsigned int path_samples = 20000;
  } // namespace



  VectorFunction::VectorFunction(const std::string &text)
    : functions(std::make_unique<ParsedFunctions<1>>(text, 3, "t"))
    , constant(text.find('t') == std::string::npos)
  {}



  Vector3
  VectorFunction::value(const double t) const
  {
    Vector3 value;
    for (unsigned int c = 0; c < 3; ++c)
      value[c] = functions->value(dealii::Point<1>(t), c);
    return value;
  }



  double
  VectorFunction::time_of_largest(const double end) const
  {
    double time = 0, largest = -1;
    if (constant)
      return time;
    for (unsigned int i = 0; i <= path_samples; ++i)
      {
        const double t = end * i / path_samples;
        if (const double length = value(t).norm(); length > largest)
          {
            largest = length;
            time    = t;
          }
      }
    return time;
  }



  double
  VectorFunction::step_within(const double path,
                              const double step,
                              const double end) const
  {
    if (constant)
      return step;

    std::vector<double> length(path_samples + 1, 0.);
    Vector3             before = value(0);
    for (unsigned int i = 1; i <= path_samples; ++i)
      {
        const Vector3 now = value(end * i / path_samples);
        length[i]         = length[i - 1] + (now - before).norm();
        before            = now;
      }
    if (length.back() <= path)
      return step;

    const unsigned int longest =
      std::ceil(std::min(1., step / end) * path_samples);
    for (unsigned int window = longest; window > 0; window = .9 * window)
      {
        double covered = 0;
        for (unsigned int i = 0; i + window <= path_samples; ++i)
          covered = std::max(covered, length[i + window] - length[i]);
        if (covered <= path)
          return std::min(step, end * window / path_samples);
      }
    return 0;
  }
} // namespace fiberloom
