// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_fabric_fabric_parameters_h
#define fiberloom_fabric_fabric_parameters_h

#include <fiberloom/base/parameters.h>

namespace fiberloom
{
  /**
   * Gives the layers of the tows their automatic values and builds what the
   * file describes once, so that whatever is wrong with it is found before
   * anything is written. Throws InputError.
   */
  void
  resolve_fabric(Parameters &parameters);
} // namespace fiberloom

#endif
