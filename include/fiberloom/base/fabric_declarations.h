// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_base_fabric_declarations_h
#define fiberloom_base_fabric_declarations_h

namespace fiberloom
{
  class ParameterCatalogue;
  struct FabricParameters;
  struct FibersParameters;

  // Sections of the parameter file that say what is made of which fibers,
  // called by Parameters::declare().

  void
  declare_fabric(ParameterCatalogue &catalogue, FabricParameters &fabric);

  void
  declare_fibers(ParameterCatalogue &catalogue, FibersParameters &fibers);
} // namespace fiberloom

#endif
