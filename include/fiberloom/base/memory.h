// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_base_memory_h
#define fiberloom_base_memory_h

#include <mpi.h>

#include <string>

namespace fiberloom
{
  constexpr double gibibyte = 1073741824.;

  /**
   * What a control group leaves to its processes [bytes], the least of the
   * group and those above; infinite without a limit. @p groups is what the
   * kernel says of this process, @p root where its control groups are mounted,
   * of either version.
   */
  double
  memory_left_in_group(const std::string &groups = "/proc/self/cgroup",
                       const std::string &root   = "/sys/fs/cgroup");

  /** What this process can still get from the computer and its control group,
   * swap space included [bytes]. */
  double
  memory_left_on_host();

  /** What its own limits, as of `ulimit -v`, leave to this process [bytes]. */
  double
  memory_left_to_process();

  /**
   * Whether a run that takes @p expected bytes on all ranks together fits into
   * what is there; if not, @p available is how much of that is. Collective.
   */
  bool
  fits_into_memory(const double   expected,
                   const MPI_Comm comm,
                   double        &available);

  /**
   * Lets BLAS take its buffers now: without memory for them OpenBLAS tries for
   * ever, whatever signals there are.
   */
  void
  reserve_blas_buffers();

  /** One line for a request of memory that failed. */
  std::string
  out_of_memory();
} // namespace fiberloom

#endif
