// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_fabric_fiber_table_h
#define fiberloom_fabric_fiber_table_h

#include <fiberloom/fabric/fiber_file.h>

namespace fiberloom
{
  /**
   * The fibers of a table with commas; '#' begins a comment, a unit may follow
   * a heading. Throws InputError with the line.
   */
  FiberFile
  read_fiber_table(const std::string &file);
} // namespace fiberloom

#endif
