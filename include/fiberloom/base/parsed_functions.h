// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_base_parsed_functions_h
#define fiberloom_base_parsed_functions_h

#include <deal.II/base/function_parser.h>
#include <deal.II/base/point.h>

#include <string>

namespace fiberloom
{
  /** Functions that the user typed, of one or two variables. */
  template <int n_variables>
  class ParsedFunctions
  {
  public:
    /**
     * @p text holds @p n_functions functions with semicolons between of the
     * @p variables , which have commas between; pi is known, too. Throws
     * InputError with what the parser says, and for random numbers.
     */
    ParsedFunctions(const std::string &text,
                    const unsigned int n_functions,
                    const std::string &variables);

    /** Value of function number @p function at @p point . */
    double
    value(const dealii::Point<n_variables> &point,
          const unsigned int                function) const
    {
      return parser.value(point, function);
    }

  private:
    dealii::FunctionParser<n_variables> parser;
  };
} // namespace fiberloom

#endif
