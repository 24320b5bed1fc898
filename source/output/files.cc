// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>

#include <fiberloom/output/files.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace fiberloom
{
  namespace
  {
    /** A file descriptor that writes all or throws. */
    class FileDescriptor
    {
    public:
      FileDescriptor(const std::string &file, const int flags)
        : name(file)
        , descriptor(::open(file.c_str(), flags | O_CLOEXEC, 0666))
      {
        if (descriptor < 0)
          fail();
      }

      ~FileDescriptor()
      {
        if (descriptor >= 0)
          ::close(descriptor);
      }

      FileDescriptor(const FileDescriptor &) = delete;

      void
      write(const std::string &content)
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
      synchronise()
      {
        if (::fsync(descriptor) != 0)
          fail();
      }

      void
      close()
      {
        const int closed = ::close(descriptor);
        descriptor       = -1;
        if (closed != 0)
          fail();
      }

    private:
      [[noreturn]] void
      fail() const
      {
        throw StageFailure("cannot write " + name + ": " +
                           std::strerror(errno));
      }

      std::string name;
      int         descriptor;
    };

    void
    synchronise_directory_of(const std::string &file)
    {
      const auto parent = std::filesystem::path(file).parent_path();
      FileDescriptor(parent.empty() ? "." : parent.string(), O_RDONLY)
        .synchronise();
    }

    std::string
    try_output_directory(const std::string &directory)
    {
      try
        {
          std::error_code error;
          std::filesystem::create_directories(directory, error);
          if (error)
            return error.message();
          const std::string probe = directory + "/.write-probe";
          FileDescriptor(probe, O_WRONLY | O_CREAT | O_TRUNC).close();
          std::filesystem::remove(probe, error);
          return "";
        }
      catch (const std::exception &error)
        {
          return error.what();
        }
    }
  } // namespace



  void
  write_file(const std::string &file,
             const std::string &content,
             const bool         durable)
  {
    const std::string aside = file + ".tmp";
    try
      {
        FileDescriptor output(aside, O_WRONLY | O_CREAT | O_TRUNC);
        output.write(content);
        if (durable)
          output.synchronise();
        output.close();
      }
    catch (...)
      {
        ::unlink(aside.c_str());
        throw;
      }
    if (std::rename(aside.c_str(), file.c_str()) != 0)
      {
        const std::string reason = std::strerror(errno);
        ::unlink(aside.c_str());
        throw StageFailure("cannot write " + file + ": " + reason);
      }
    if (durable)
      synchronise_directory_of(file);
  }



  std::string
  read_file(const std::string &file)
  {
    if (std::filesystem::is_directory(file))
      throw InputError(file + ": is a directory, not a file");
    std::ifstream      input(file, std::ios::binary);
    std::ostringstream content;
    if (!input || !(content << input.rdbuf()))
      throw InputError(file + ": cannot be read" +
                       (std::filesystem::exists(file) ? "" : ", no such file"));
    return content.str();
  }



  void
  collectively(const MPI_Comm comm, const std::function<void()> &work)
  {
    using namespace dealii::Utilities::MPI;

    std::string message;
    bool        failed = false;
    try
      {
        work();
      }
    catch (const std::exception &error)
      {
        failed  = true;
        message = error.what();
      }

    const unsigned int n_ranks = n_mpi_processes(comm);
    const unsigned int first =
      min(failed ? this_mpi_process(comm) : n_ranks, comm);
    if (first < n_ranks)
      throw StageFailure(broadcast(comm, message, first));
  }



  void
  prepare_output_directory(const std::string &directory, const MPI_Comm comm)
  {
    using namespace dealii::Utilities::MPI;

    std::string reason;
    if (this_mpi_process(comm) == 0)
      reason = try_output_directory(directory);
    reason = broadcast(comm, reason, 0);
    if (!reason.empty())
      throw InputError("Output directory: " + directory + " is no use (" +
                       reason +
                       "); allowed is a directory that exists or can be "
                       "created");
  }
} // namespace fiberloom
