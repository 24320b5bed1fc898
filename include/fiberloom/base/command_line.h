// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_base_command_line_h
#define fiberloom_base_command_line_h

#include <iosfwd>
#include <string>
#include <vector>

namespace fiberloom
{
  /** What the user asked for: fiberloom FILE.prm [options]. */
  struct CommandLine
  {
    std::string              file;      // empty only when it is not needed
    std::vector<std::string> overrides; // "Section/Entry=value", in order
    std::string              restart;   // checkpoint file, or empty
    bool                     check            = false;
    bool                     print_parameters = false;
    bool                     print_reference  = false;
    bool                     help             = false;
    bool                     version          = false;

    /**
     * Throws InputError with one line for anything that is not understood.
     * --output-directory becomes the last of the overrides.
     */
    static CommandLine
    parse(const int argc, const char *const *argv);

    static void
    print_help(std::ostream &out);
  };
} // namespace fiberloom

#endif
