// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/log.h>

#include <deal.II/base/mpi.h>

#include <fcntl.h>
#include <unistd.h>

#include <iostream>

namespace fiberloom
{
  namespace
  {
    /** The file @p name cut to @p kept bytes, to be gone on with; null if it is
     * shorter or does not begin with @p title . */
    std::unique_ptr<FileDescriptor>
    former_log(const std::string  &name,
               const std::string  &title,
               const std::uint64_t kept)
    {
      try
        {
          auto file = std::make_unique<FileDescriptor>(name, O_RDWR | O_APPEND);
          std::string begin(title.size(), ' ');
          if (!file->is_regular() || file->size() < kept ||
              ::pread(file->number(), begin.data(), begin.size(), 0) !=
                ssize_t(begin.size()) ||
              begin != title || ::ftruncate(file->number(), kept) != 0)
            return nullptr;
          return file;
        }
      catch (const StageFailure &)
        {
          return nullptr;
        }
    }
  } // namespace

  Log::Log(const MPI_Comm comm)
    : is_first_rank(dealii::Utilities::MPI::this_mpi_process(comm) == 0)
  {}

  void
  Log::open(const std::string  &directory,
            const std::string  &title,
            const std::uint64_t kept)
  {
    if (!is_first_rank)
      return;
    const std::string name = directory + "/log.txt", line = title + "\n";
    std::cout << line << std::flush;
    try
      {
        file = kept > 0 ? former_log(name, line, kept) : nullptr;
        if (file)
          written = kept;
        else
          {
            file.reset(new FileDescriptor(FileDescriptor::create(name)));
            write_to_file(line);
          }
        write_to_file(before_open);
        before_open.clear();
      }
    catch (const StageFailure &failure)
      {
        std::cout << failure.what() << std::endl;
      }
  }

  void
  Log::write(const std::string &text)
  {
    if (!is_first_rank)
      return;
    last_line = std::chrono::steady_clock::now();
    const std::string lines =
      text.empty() || text.back() != '\n' ? text + '\n' : text;
    std::cout << lines << std::flush;
    if (file)
      write_to_file(lines);
    else
      before_open += lines;
  }

  double
  Log::silence() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() -
                                         last_line)
      .count();
  }

  void
  Log::synchronise()
  {
    if (file)
      ::fsync(file->number());
  }

  void
  Log::write_to_file(const std::string &text)
  {
    // it goes on as soon as there is room
    try
      {
        file->write(text);
      }
    catch (const StageFailure &)
      {
        std::cout << "log.txt cannot be written" << std::endl;
      }
    written = file->size();
  }
} // namespace fiberloom
