// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_fabric_input_notes_h
#define fiberloom_fabric_input_notes_h

#include <fiberloom/fabric/fiber_set.h>

#include <string>
#include <vector>

namespace fiberloom
{
  struct Parameters;

  /**
   * What the user should know of an input that is accepted, a line each:
   * entries set twice, columns of files that are not read, weaves cut off
   * within their period, and values that no fiber has, with the unit that was
   * likely meant.
   */
  std::vector<std::string>
  input_notes(const Parameters &parameters, const FiberSet &fibers);
} // namespace fiberloom

#endif
