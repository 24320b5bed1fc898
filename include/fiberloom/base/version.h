// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_base_version_h
#define fiberloom_base_version_h

#include <string>
#include <utility>
#include <vector>

namespace fiberloom
{
  std::string
  program_name();

  /** The version that was configured, such as "0.1.0". */
  std::string
  program_version();

  /** The git revision that was built, or "unknown". */
  std::string
  program_revision();

  /** Names and versions of the libraries the program was compiled with. */
  std::vector<std::pair<std::string, std::string>>
  library_versions();

  /** All of these: one line for the program, one for the libraries. */
  std::string
  version_text();
} // namespace fiberloom

#endif
