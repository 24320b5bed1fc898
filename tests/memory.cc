// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// What control groups of either version leave, which the kernel tells in files,
// and what the limit of a process leaves.

#include <fiberloom/base/memory.h>

#include <deal.II/base/mpi.h>

#include <sys/resource.h>

#include <cmath>
#include <filesystem>
#include <fstream>

using namespace fiberloom;

namespace
{
  void
  write(const std::string &file, const std::string &text)
  {
    std::filesystem::create_directories(
      std::filesystem::absolute(file).parent_path());
    std::ofstream(file) << text;
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::ofstream                            out("output");

  // The limit above is the closer one; pages of files can be had back.
  write("second/job/memory.max", "7000\n");
  write("second/job/memory.current", "2000\n");
  write("second/job/memory.stat", "anon 1500\ninactive_file 500\n");
  write("second/job/step/memory.max", "max\n");
  write("second/job/step/memory.current", "2000\n");
  write("groups", "0::/job/step\n");
  out << "version 2 leaves " << memory_left_in_group("groups", "second")
      << "\n";

  write("first/memory/job/memory.limit_in_bytes", "9000\n");
  write("first/memory/job/memory.usage_in_bytes", "3000\n");
  write("first/memory/job/memory.stat", "total_inactive_file 100\n");
  write("groups", "7:cpu:/other\n4:memory:/job\n0::/\n");
  out << "version 1 leaves " << memory_left_in_group("groups", "first") << "\n";

  // Used up, and not there at all.
  write("first/memory/job/memory.usage_in_bytes", "9900\n");
  out << "used up leaves " << memory_left_in_group("groups", "first") << "\n";
  write("groups", "0::/elsewhere\n");
  out << "no limit is infinite "
      << std::isinf(memory_left_in_group("groups", "absent")) << "\n";

  out << "this computer has some " << (memory_left_on_host() > 1e6) << "\n";
  double     available;
  const bool little = fits_into_memory(1e6, MPI_COMM_WORLD, available);
  out << "a little fits " << little;
  out << ", all of it and more does not "
      << !fits_into_memory(2 * available, MPI_COMM_WORLD, available) << "\n";

  rlimit limits;
  getrlimit(RLIMIT_AS, &limits);
  limits.rlim_cur = rlim_t(1) << 20;
  setrlimit(RLIMIT_AS, &limits);
  const double left = memory_left_to_process();
  const bool   fits = fits_into_memory(1e6, MPI_COMM_WORLD, available);
  limits.rlim_cur   = limits.rlim_max;
  setrlimit(RLIMIT_AS, &limits);
  out << "beyond its limit a process has " << left << ", and fits " << fits
      << "\n";
}
