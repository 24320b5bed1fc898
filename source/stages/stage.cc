// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/parameters.h>

#include <fiberloom/stages/stage.h>

namespace fiberloom
{
  ContactRule
  Stage::rule(const double) const
  {
    ContactRule rule;
    rule.friction = scene.parameters.contact.friction_coefficient > 0;
    return rule;
  }
} // namespace fiberloom
