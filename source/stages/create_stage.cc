// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>

#include <fiberloom/stages/bend.h>
#include <fiberloom/stages/biaxial.h>
#include <fiberloom/stages/coat.h>
#include <fiberloom/stages/compact.h>
#include <fiberloom/stages/load.h>
#include <fiberloom/stages/relax.h>
#include <fiberloom/stages/shear.h>
#include <fiberloom/stages/stiffness.h>
#include <fiberloom/stages/weave.h>

namespace fiberloom
{
  std::unique_ptr<Stage>
  create_stage(const std::string &name, const Scene &scene)
  {
    if (name == "weave")
      return std::make_unique<Weave>(scene);
    if (name == "relax")
      return std::make_unique<Relax>(scene);
    if (name == "coat")
      return std::make_unique<Coat>(scene);
    if (name == "shear")
      return std::make_unique<Shear>(scene);
    if (name == "bend")
      return std::make_unique<Bend>(scene);
    if (name == "biaxial")
      return std::make_unique<Biaxial>(scene);
    if (name == "compact")
      return std::make_unique<Compact>(scene);
    if (name == "stiffness")
      return std::make_unique<Stiffness>(scene);
    if (name == "load")
      return std::make_unique<Load>(scene);
    throw InputError(
      "Stages: \"" + name +
      "\" is unknown; there are weave, relax, coat, biaxial, shear, "
      "bend, compact, stiffness, load");
  }
} // namespace fiberloom
