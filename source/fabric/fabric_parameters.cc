// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>

#include <fiberloom/fabric/fabric_parameters.h>
#include <fiberloom/fabric/fiber_set.h>
#include <fiberloom/fabric/tow_packing.h>

#include <deal.II/base/utilities.h>

#include <set>

namespace fiberloom
{
  namespace
  {
    /** Every end exists and is held once. */
    void
    check_drive_ends(const Parameters &parameters, const std::size_t n_fibers)
    {
      std::set<std::string> held;
      for (const DriveParameters &drive : parameters.drives)
        for (const std::string &end :
             dealii::Utilities::split_string_list(drive.ends, ','))
          {
            const std::string where =
              parameters.where("Drive " + drive.name + "/Ends");
            if (std::stoul(end) >= n_fibers)
              throw InputError(where + ": there is no fiber for " + end +
                               "; allowed: numbers from 0 to " +
                               std::to_string(n_fibers - 1));
            if (!held.insert(end).second)
              throw InputError(where + ": " + end +
                               " is held twice; allowed: once");
          }
    }
  } // namespace

  void
  resolve_fabric(Parameters &parameters)
  {
    for (TowParameters *tows :
         {&parameters.fabric.warp, &parameters.fabric.fill})
      if (tows->layers.empty())
        tows->layers = default_layers(tows->fibers);

    const FiberSet fibers = build_fiber_set(parameters);
    check_drive_ends(parameters, fibers.fibers.size());
  }
} // namespace fiberloom
