// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_base_input_file_h
#define fiberloom_base_input_file_h

#include <cstdint>
#include <fstream>
#include <string>

namespace fiberloom
{
  /**
   * Opens a file that the user named. What is no regular file, such as a FIFO
   * or a device, could keep the program waiting or never end, and is refused as
   * is one of more than @p most_bytes . Throws InputError with the reason,
   * without the name of the file.
   */
  std::ifstream
  open_input_file(const std::string &file, const std::uintmax_t most_bytes);

  /** Reads all of a file that the user named, with the same errors. */
  std::string
  read_input_file(const std::string &file, const std::uintmax_t most_bytes);
} // namespace fiberloom

#endif
