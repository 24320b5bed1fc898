// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/input_file.h>

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace fiberloom
{
  std::ifstream
  open_input_file(const std::string &file, const std::uintmax_t most_bytes)
  {
    // not std::filesystem, which throws of its own for a loop of links
    struct stat status;
    if (::stat(file.c_str(), &status) != 0)
      throw InputError(std::string("cannot be read: ") + std::strerror(errno));
    if (S_ISDIR(status.st_mode))
      throw InputError("is a directory; allowed: a file");
    if (!S_ISREG(status.st_mode))
      throw InputError("is no regular file but a device, a pipe or the like; "
                       "allowed: a file");
    if (static_cast<std::uintmax_t>(status.st_size) > most_bytes)
      throw InputError("has " + std::to_string(status.st_size) +
                       " bytes; allowed: at most " +
                       std::to_string(most_bytes));
    std::ifstream in(file, std::ios::binary);
    if (!in)
      throw InputError(std::string("cannot be read: ") + std::strerror(errno));
    return in;
  }



  std::string
  read_input_file(const std::string &file, const std::uintmax_t most_bytes)
  {
    std::ifstream in = open_input_file(file, most_bytes);
    in.seekg(0, std::ios::end);
    std::string content(std::max<std::streamoff>(in.tellg(), 0), ' ');
    in.seekg(0);
    if (!in.read(content.data(), content.size()))
      throw InputError("cannot be read");
    return content;
  }
} // namespace fiberloom
