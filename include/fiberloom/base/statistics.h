// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_base_statistics_h
#define fiberloom_base_statistics_h

#include <cstddef>
#include <string>
#include <vector>

namespace fiberloom
{
  /** Where the time of a stage went [s]. */
  struct Seconds
  {
    double detection     = 0;
    double assembly      = 0;
    double linear_solver = 0; // of which the next three
    double analysis      = 0; // fill-reducing ordering, symbolic factorisation
    double factorization = 0;
    double krylov        = 0;
    double output        = 0;
    double yardstick     = 0; // one factorisation in double precision, for
                              // comparison
    double wall = 0;          // all of these and the rest
  };

  /** What a stage cost and reached; one entry of "stages" in summary.json. */
  struct StageStatistics
  {
    std::string  name;
    bool         converged                       = false;
    unsigned int increments                      = 0;
    unsigned int rejected_increments             = 0;
    unsigned int contact_updates                 = 0;
    unsigned int normal_updates                  = 0;
    unsigned int newton_iterations               = 0;
    unsigned int linear_iterations               = 0;
    unsigned int factorizations                  = 0;
    double       largest_penetration_over_radius = 0;
    unsigned int crossings_out_of_order          = 0;
    std::size_t  contact_elements                = 0;
    Seconds      seconds;
  };

  /** The sizes of a model; "model" in summary.json. */
  struct ModelSize
  {
    unsigned int fibers           = 0;
    unsigned int nodes            = 0;
    unsigned int fiber_elements   = 0;
    std::size_t  fiber_dofs       = 0;
    std::size_t  matrix_dofs      = 0;
    std::size_t  contact_elements = 0;
    std::size_t  junctions        = 0;
  };
} // namespace fiberloom

#endif
