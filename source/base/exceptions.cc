// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/memory.h>

#include <deal.II/base/exceptions.h>

#include <new>
#include <sstream>

namespace fiberloom
{
  namespace
  {
    constexpr std::size_t longest_end = 500; // of a message, in characters
  }

  std::string
  one_line(const std::exception &exception)
  {
    std::stringstream text;
    if (const auto *library_exception =
          dynamic_cast<const dealii::ExceptionBase *>(&exception))
      library_exception->print_info(text);
    else if (dynamic_cast<const std::bad_alloc *>(&exception))
      text << out_of_memory();
    else
      text << exception.what();

    std::string line, word;
    while (text >> word)
      line += (line.empty() ? "" : " ") + word;
    // a value may be as long as a file, but place and reason stand at the ends
    if (line.size() > 2 * longest_end)
      line = line.substr(0, longest_end) + " ... " +
             line.substr(line.size() - longest_end);
    return line;
  }
} // namespace fiberloom
