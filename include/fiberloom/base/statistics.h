// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_base_statistics_h
#define fiberloom_base_statistics_h

#include <cstddef>
#include <limits>
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
    double coarse   = 0;      // all on coarser meshes
    double wall     = 0;      // all of these and the rest
    double estimate = 0;      // of the error, afterwards
  };

  /**
   * Estimated errors of the loading curve at the end of a stage, over its
   * largest value; NaN where there is none.
   */
  struct ErrorEstimate
  {
    double      mesh        = std::numeric_limits<double>::quiet_NaN();
    double      stations    = std::numeric_limits<double>::quiet_NaN();
    double      penetration = std::numeric_limits<double>::quiet_NaN();
    double      matrix      = std::numeric_limits<double>::quiet_NaN();
    double      total       = std::numeric_limits<double>::quiet_NaN();
    double      tolerance   = std::numeric_limits<double>::quiet_NaN();
    std::string column      = {}; // of the curve, where the total is
    double      change      = 0;  // of that column, in its unit
  };

  /** Energies where a stage's way begins or turns [N mm]. */
  struct TurningPoint
  {
    double part     = 0; // of the largest deformation
    double work     = 0; // done on the sample since the stage began
    double friction = 0; // lost by it since the first stage began
    double stored   = 0;
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
    unsigned int coarse_iterations               = 0; // on coarser meshes
    unsigned int linear_iterations               = 0;
    unsigned int factorizations                  = 0;
    double       largest_penetration_over_radius = 0;
    double       largest_section_change          = 0; // over its width
    double       elastic_energy                  = 0; // [N mm]
    int          negative_pivots                 = 0; // of the last tangent
    unsigned int crossings_out_of_order          = 0;
    std::size_t  contact_elements                = 0;
    std::size_t  broken                          = 0; // elements of fibers
    Seconds      seconds;

    ErrorEstimate estimated_error;

    std::vector<double> membrane_stiffness;   // 3 x 3 [N/mm], if asked for
    double              filled_thickness = 0; // of a cell, then [mm]

    std::vector<TurningPoint> turning_points; // from the start of the way on

    // What a scene can do without.
    unsigned int unsymmetric_systems = 0; // among those solved
    unsigned int searches            = 0; // trees over all fibers
    std::size_t  friction_history    = 0; // slips remembered
    std::size_t  exchanged_values    = 0; // by ranks in a product
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
    std::size_t  matrix_cells     = 0;
  };
} // namespace fiberloom

#endif
