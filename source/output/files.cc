// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/file_descriptor.h>

#include <fiberloom/output/files.h>

#include <deal.II/base/mpi.h>

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
    void
    synchronise_directory_of(const std::string &file)
    {
      const auto parent = std::filesystem::path(file).parent_path();
      // The directory may itself be reached through a link.
      FileDescriptor((parent / ".").string(), O_RDONLY).synchronise();
    }
  } // namespace



  void
  write_file(const std::string &file,
             const std::string &content,
             const Durability   durability)
  {
    const std::string aside = file + ".tmp";
    try
      {
        FileDescriptor output = FileDescriptor::create(aside);
        output.write(content);
        if (durability == Durability::on_disk)
          output.synchronise();
        output.close();
        rename_file(aside, file, durability);
      }
    catch (...)
      {
        ::unlink(aside.c_str());
        throw;
      }
  }



  void
  rename_file(const std::string &file,
              const std::string &to,
              const Durability   durability)
  {
    if (std::rename(file.c_str(), to.c_str()) != 0)
      throw StageFailure("cannot write " + to + ": " + std::strerror(errno));
    if (durability == Durability::on_disk)
      synchronise_directory_of(to);
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
        message = one_line(error);
      }

    const unsigned int n_ranks = n_mpi_processes(comm);
    const unsigned int first =
      min(failed ? this_mpi_process(comm) : n_ranks, comm);
    if (first < n_ranks)
      throw StageFailure(broadcast(comm, message, first));
  }
} // namespace fiberloom
