// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/parsed_functions.h>

#include <deal.II/base/point.h>

#include <cctype>
#include <cmath>
#include <iostream>
#include <sstream>

namespace fiberloom
{
  namespace
  {
    bool
    is_of_name(const char c)
    {
      return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
    }

    /** Throws InputError for names whose value is another one each time. */
    void
    check_repeatable(const std::string &functions)
    {
      for (std::size_t i = 0; i < functions.size();)
        {
          std::size_t end = i;
          while (end < functions.size() && is_of_name(functions[end]))
            ++end;
          const std::string name = functions.substr(i, end - i);
          if (name == "rand" || name == "rand_seed")
            throw InputError(name + " makes runs that do not repeat");
          i = end + 1;
        }
    }
  } // namespace

  template <int n_variables>
  ParsedFunctions<n_variables>::ParsedFunctions(const std::string &text,
                                                const unsigned int n_functions,
                                                const std::string &variables)
    : parser(n_functions)
  {
    check_repeatable(text);
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
