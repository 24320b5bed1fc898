// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>

#include <fiberloom/fabric/fabric_parameters.h>
#include <fiberloom/fabric/fiber_points.h>
#include <fiberloom/fabric/fiber_set.h>
#include <fiberloom/fabric/tow_packing.h>

#include <map>

namespace fiberloom
{
  namespace
  {
    /** Runs @p find , whose errors get the place of @p entry . */
    template <class Find>
    auto
    found_at(const Parameters  &parameters,
             const std::string &entry,
             const Find        &find)
    {
      try
        {
          return find();
        }
      catch (const InputError &error)
        {
          throw InputError(parameters.where(entry) + ": " + error.what());
        }
    }

    /** Every point that drives hold exists and is held once. */
    void
    check_drive_ends(const Parameters &parameters, const FiberSet &fibers)
    {
      std::map<std::pair<unsigned int, unsigned int>, std::string> holder;
      for (const DriveParameters &drive : parameters.drives)
        {
          const std::string entry = "Drive " + drive.name + "/Ends";
          for (const FiberPoint &point :
               found_at(parameters, entry, [&drive, &fibers]() {
                 return find_points(drive.ends, fibers);
               }))
            {
              const auto [held, is_new] = holder.insert(
                {{point.fiber, point.nearest_node()}, drive.name});
              if (!is_new)
                throw InputError(
                  parameters.where(entry) + ": fiber " +
                  std::to_string(point.fiber) + " " + point.name +
                  (held->second == drive.name ?
                     " is held twice" :
                     " is held twice, by drive " + held->second + ", too") +
                  "; allowed: once");
            }
        }
    }

    /** Of a file, which has a fabric only if it has its tows. */
    void
    check_stages(const Parameters &parameters, const FiberSet &fibers)
    {
      for (const std::string &stage : parameters.stages)
        if (!fibers.pattern && stage != "load" && stage != "coat")
          throw InputError(
            parameters.where("Stages") + ": " + stage +
            " needs a fabric, but Fibers/File has no columns tow and family "
            "with warp and fill; allowed: coat, load, or a file with them");
    }

    void
    check_load_lists(const Parameters &parameters, const FiberSet &fibers)
    {
      const LoadParameters &load = parameters.load;
      found_at(parameters, "Load/Loaded fibers", [&load, &fibers]() {
        return find_fibers(load.loaded_fibers, fibers);
      });
      found_at(parameters, "Load/Probes", [&load, &fibers]() {
        return find_points(load.probes, fibers);
      });
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
    check_stages(parameters, fibers);
    check_drive_ends(parameters, fibers);
    check_load_lists(parameters, fibers);
  }
} // namespace fiberloom
