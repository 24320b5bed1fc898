// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_reactions_h
#define fiberloom_output_reactions_h

#include <fiberloom/stages/stage.h>

#include <fiberloom/output/increment_table.h>

namespace fiberloom
{
  /**
   * The rows of reactions.csv, one for each rigid body and accepted increment:
   * where its reference point is [mm], and the force [N] and the moment about
   * that point [N mm] that it exerts on the fibers.
   */
  class ReactionTable : public IncrementTable
  {
  public:
    ReactionTable();

    void
    append(const IncrementReport &report);
  };
} // namespace fiberloom

#endif
