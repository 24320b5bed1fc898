// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_base_drive_parameters_h
#define fiberloom_base_drive_parameters_h

#include <fiberloom/base/choices.h>
#include <fiberloom/base/given_text.h>

#include <string>

namespace fiberloom
{
  class ParameterCatalogue;

  /**
   * A rigid body that holds points of fibers, and what moves or loads it.
   * Functions depend on t, which runs from 0 to LoadSettings::end in stage
   * "load".
   */
  struct DriveParameters
  {
    std::string                 name;
    std::string                 ends; // "0 start, all end, 3 at 0.5"
    Hold                        hold = Hold::clamped;
    NamedSet<PointHold>         held; // instead of hold, in detail
    NamedSet<BodyDof>           free; // of the body
    NamedSet<MatrixBorder, ','> matrix_borders;
    NamedSet<Component>         matrix_held = "x y z"; // of the nodes of these
    GivenPoint                  center; // of the body [mm], else the mean
    std::string                 translation = "0; 0; 0"; // [mm] functions of t
    std::string rotation = "0; 0; 0"; // [rad] rotation vector, functions of t
    std::string force    = "0; 0; 0"; // [N] on free degrees of freedom
    std::string moment   = "0; 0; 0"; // [N mm] on free degrees of freedom

    /** A section with its name. */
    void
    declare(ParameterCatalogue &catalogue);
  };
} // namespace fiberloom

#endif
