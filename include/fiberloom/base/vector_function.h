// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_base_vector_function_h
#define fiberloom_base_vector_function_h

#include <fiberloom/base/parsed_functions.h>
#include <fiberloom/base/vector_types.h>

#include <memory>
#include <string>

namespace fiberloom
{
  /** A vector that the user gave as three functions of t. */
  class VectorFunction
  {
  public:
    /** Throws InputError with what the parser says. */
    explicit VectorFunction(const std::string &text);

    /** The three components at @p t , which need not be finite. */
    Vector3
    value(const double t) const;

    /** Whether it does not depend on t. */
    bool
    is_constant() const
    {
      return constant;
    }

    /** Where in [0, @p end ] the vector is longest. */
    double
    time_of_largest(const double end) const;

    /**
     * The longest interval of t, at most @p step , during which the vector
     * nowhere in [0, @p end ] covers a path longer than @p path . 0 if it
     * jumps by more.
     */
    double
    step_within(const double path, const double step, const double end) const;

  private:
    std::unique_ptr<const ParsedFunctions<1>> functions;

    /** No letter t in it: no need to sample it. */
    bool constant;
  };
} // namespace fiberloom

#endif
