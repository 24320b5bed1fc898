// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_base_composite_declarations_h
#define fiberloom_base_composite_declarations_h

#include <string>
#include <vector>

namespace fiberloom
{
  class ParameterCatalogue;
  struct MatrixParameters;
  struct ShearParameters;
  struct BendParameters;

  /** Entry Way of the section of a test: turning points as parts of @p whole ,
   * such as "the largest strain", from @p lowest to 1. */
  void
  declare_way(ParameterCatalogue  &catalogue,
              std::vector<double> &way,
              const std::string   &whole,
              const int            lowest);

  // Sections of the parameter file for the matrix and its tests, called by
  // Parameters::declare().

  void
  declare_matrix(ParameterCatalogue &catalogue, MatrixParameters &matrix);

  void
  declare_shear(ParameterCatalogue &catalogue, ShearParameters &shear);

  void
  declare_bend(ParameterCatalogue &catalogue, BendParameters &bend);
} // namespace fiberloom

#endif
