// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// The stages there are: a new one is named here.

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
  const std::vector<StageType> &
  stage_types()
  {
    static const std::vector<StageType> types = {Weave::type(),
                                                 Relax::type(),
                                                 Coat::type(),
                                                 Biaxial::type(),
                                                 Shear::type(),
                                                 Bend::type(),
                                                 Compact::type(),
                                                 Stiffness::type(),
                                                 Load::type()};
    return types;
  }



  std::unique_ptr<Stage>
  create_stage(const std::string &name, const Scene &scene)
  {
    return stage_type(name).create(scene);
  }
} // namespace fiberloom
