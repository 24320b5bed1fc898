// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_summary_h
#define fiberloom_output_summary_h

#include <fiberloom/base/statistics.h>

#include <mpi.h>

#include <string>
#include <utility>
#include <vector>

namespace fiberloom
{
  /** What summary.json says, see doc/manual.md. */
  struct Summary
  {
    std::string                                 version;
    std::string                                 revision;
    std::string                                 run; // its id
    unsigned int                                ranks     = 1;
    bool                                        preview   = false;
    bool                                        converged = false;
    ModelSize                                   model;
    std::vector<StageStatistics>                stages;
    std::vector<std::pair<std::string, double>> fabric; // empty: no member
    double                                      peak_memory_bytes = 0;
  };

  /**
   * @p summary as a JSON object. Numbers read back as they are; those that are
   * not finite become null. Bytes that are no UTF-8 become U+FFFD.
   */
  std::string
  summary_json(const Summary &summary);

  /** Largest resident memory so far, summed over the ranks. Collective. */
  double
  peak_memory_bytes(const MPI_Comm comm);
} // namespace fiberloom

#endif
