// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/parsed_functions.h>

#include <cmath>
#include <iostream>
#include <sstream>

namespace fiberloom
{
  template <int n_variables>
  ParsedFunctions<n_variables>::ParsedFunctions(const std::string &text,
                                                const unsigned int n_functions,
                                                const std::string &variables)
    : parser(n_functions)
  {
    // the parser tells the screen about errors before it throws
    std::ostringstream    unheard;
    std::streambuf *const screen = std::cerr.rdbuf(unheard.rdbuf());
    std::string           error;
    try
      {
        parser.initialize(variables, text, {{"pi", M_PI}});
        for (unsigned int i = 0; i < n_functions; ++i)
          parser.value(dealii::Point<n_variables>(), i);
      }
    catch (const std::exception &exception)
      {
        error = one_line(exception);
      }
    std::cerr.rdbuf(screen);
    if (!error.empty())
      throw InputError(error);
  }

  template class ParsedFunctions<1>;
  template class ParsedFunctions<2>;
} // namespace fiberloom
