// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/output/curves.h>
#include <fiberloom/output/reactions.h>

namespace fiberloom
{
  ReactionTable::ReactionTable()
    : IncrementTable("reactions.csv", "body")
  {}



  void
  ReactionTable::append(const IncrementReport &report)
  {
    const State &state = report.state;
    for (unsigned int b = 0; b < report.reactions.size(); ++b)
      {
        const Vector3    &x = state.placements[b].position;
        const BodyVector &f = report.reactions[b];
        IncrementTable::append(place_of(report),
                               report.supports.bodies[b].name,
                               {{"x[mm]", table_cell(x[0])},
                                {"y[mm]", table_cell(x[1])},
                                {"z[mm]", table_cell(x[2])},
                                {"force_x[N]", table_cell(f[0])},
                                {"force_y[N]", table_cell(f[1])},
                                {"force_z[N]", table_cell(f[2])},
                                {"moment_x[N.mm]", table_cell(f[3])},
                                {"moment_y[N.mm]", table_cell(f[4])},
                                {"moment_z[N.mm]", table_cell(f[5])}});
      }
  }
} // namespace fiberloom
