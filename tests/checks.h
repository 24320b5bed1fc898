// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_tests_checks_h
#define fiberloom_tests_checks_h

#include <Eigen/Core>

#include <cmath>
#include <iostream>
#include <ostream>
#include <string>

/** Writes a line for each claim that is the same in every run if it holds. */
class Checks
{
public:
  explicit Checks(std::ostream &output)
    : output(output)
  {}

  /** The screen gets the number, so that one sees how much room there is. */
  void
  below(const std::string &name, const double value, const double bound)
  {
    std::cout << name << ": " << value << std::endl;
    if (std::abs(value) < bound)
      output << name << " below " << bound << ": ok" << std::endl;
    else
      output << name << ": " << value << " is not below " << bound << std::endl;
  }

  void
  above(const std::string &name, const double value, const double bound)
  {
    std::cout << name << ": " << value << std::endl;
    if (value > bound)
      output << name << " above " << bound << ": ok" << std::endl;
    else
      output << name << ": " << value << " is not above " << bound << std::endl;
  }

  void
  equal(const std::string &name, const double value, const double expected)
  {
    std::cout << name << ": " << value << std::endl;
    if (std::abs(value - expected) < 1e-9)
      output << name << " is " << expected << ": ok" << std::endl;
    else
      output << name << ": " << value << " is not " << expected << std::endl;
  }

  void
  that(const std::string &name, const bool claim)
  {
    output << name << ": " << (claim ? "ok" : "wrong") << std::endl;
  }

private:
  std::ostream &output;
};

/** Largest entry of the difference over the largest of @p exact . */
template <class A, class B>
double
relative_error(const A &computed, const B &exact)
{
  return (computed - exact).cwiseAbs().maxCoeff() / exact.cwiseAbs().maxCoeff();
}

/** Central differences of a scalar function. */
template <class Vector, class Function>
Vector
difference_gradient(const Function &f, const Vector &x, const double step)
{
  Vector gradient(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i)
    {
      Vector before = x, after = x;
      before[i] -= step;
      after[i] += step;
      gradient[i] = (f(after) - f(before)) / (2 * step);
    }
  return gradient;
}

/** Central differences of a vector function with as many results as arguments.
 */
template <class Vector, class Function>
Eigen::MatrixXd
difference_jacobian(const Function &f, const Vector &x, const double step)
{
  Eigen::MatrixXd jacobian(x.size(), x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i)
    {
      Vector before = x, after = x;
      before[i] -= step;
      after[i] += step;
      jacobian.col(i) = (f(after) - f(before)) / (2 * step);
    }
  return jacobian;
}

#endif
