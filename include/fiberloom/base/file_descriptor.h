// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_base_file_descriptor_h
#define fiberloom_base_file_descriptor_h

#include <cstdint>
#include <string>

namespace fiberloom
{
  /**
   * An open file that writes all or throws StageFailure with the system's
   * reason. Links are not followed, and nothing waits for the other end of a
   * pipe.
   */
  class FileDescriptor
  {
  public:
    /** Opens what is there, a directory, too; @p flags as for open(). */
    FileDescriptor(const std::string &file, const int flags);

    ~FileDescriptor();

    FileDescriptor(const FileDescriptor &) = delete;

    FileDescriptor &
    operator=(const FileDescriptor &) = delete;

    /**
     * Creates a new file, which nobody else can have made, in place of what had
     * the name before: a link, a pipe or what a killed run has left.
     */
    static FileDescriptor
    create(const std::string &file);

    int
    number() const
    {
      return descriptor;
    }

    bool
    is_regular() const;

    /** Size of the file in bytes; 0 where the system does not tell. */
    std::uint64_t
    size() const;

    /** Writes all of @p content . Throws StageFailure. */
    void
    write(const std::string &content);

    /** Waits until all is on the disk. */
    void
    synchronise();

    /** Closes the file; throws what a disk reports late. */
    void
    close();

  private:
    [[noreturn]] void
    fail() const;

    std::string name;
    int         descriptor;
  };
} // namespace fiberloom

#endif
