// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_matrix_matrix_parameters_h
#define fiberloom_matrix_matrix_parameters_h

#include <fiberloom/base/choices.h>

namespace fiberloom
{
  /**
   * The layers of matrix that stage "coat" adds. Zero marks an automatic value,
   * see CoatSettings::resolve().
   */
  struct MatrixParameters
  {
    Layers       layers    = Layers::none;
    double       thickness = 0;          // beyond the outermost skin [mm]
    double       overlap   = 0;          // of layers and outer fibers [mm]
    double       size_x = 0, size_y = 0; // [mm], 0: that of the fibers
    unsigned int cells_along_x           = 0;
    unsigned int cells_along_y           = 0;
    unsigned int cells_through_thickness = 1;
    unsigned int degree                  = 2;
    MatrixLaw    law                     = MatrixLaw::neo_hooke;
    double       young_modulus           = 50; // [MPa]
    double       poisson_ratio           = 0.35;
    double       junction_spacing        = 0; // along the fibers [mm]
    double       junction_stiffness = 0; // per length [MPa], 0: by the modulus
    double       junction_reach     = 4; // over the fiber radius
  };
} // namespace fiberloom

#endif
