// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_base_matrix_declarations_h
#define fiberloom_base_matrix_declarations_h

namespace fiberloom
{
  class ParameterCatalogue;
  struct MatrixParameters;

  /** The section of the matrix, called by Parameters::declare(). */
  void
  declare_matrix(ParameterCatalogue &catalogue, MatrixParameters &matrix);
} // namespace fiberloom

#endif
