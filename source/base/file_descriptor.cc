// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/file_descriptor.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace fiberloom
{
  FileDescriptor::FileDescriptor(const std::string &file, const int flags)
    : name(file)
    , descriptor(
        ::open(file.c_str(), flags | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666))
  {
    if (descriptor < 0)
      fail();
  }

  FileDescriptor::~FileDescriptor()
  {
    if (descriptor >= 0)
      ::close(descriptor);
  }

  FileDescriptor
  FileDescriptor::create(const std::string &file)
  {
    ::unlink(file.c_str());
    return {file, O_WRONLY | O_CREAT | O_EXCL};
  }

  bool
  FileDescriptor::is_regular() const
  {
    struct stat status;
    return ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
  }

  std::uint64_t
  FileDescriptor::size() const
  {
    struct stat status;
    return ::fstat(descriptor, &status) == 0 ? status.st_size : 0;
  }

  void
  FileDescriptor::write(const std::string &content)
  {
    std::size_t written = 0;
    while (written < content.size())
      {
        const auto n = ::write(descriptor,
                               content.data() + written,
                               content.size() - written);
        if (n < 0 && errno != EINTR)
          fail();
        if (n > 0)
          written += n;
      }
  }

  void
  FileDescriptor::synchronise()
  {
    // Some network file systems cannot do so for directories.
    if (::fsync(descriptor) != 0 && errno != EINVAL && errno != ENOTSUP)
      fail();
  }

  void
  FileDescriptor::close()
  {
    const int closed = ::close(descriptor);
    descriptor       = -1;
    if (closed != 0)
      fail();
  }

  void
  FileDescriptor::fail() const
  {
    throw StageFailure("cannot write " + name + ": " + std::strerror(errno));
  }
} // namespace fiberloom
