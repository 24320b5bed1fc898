// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/parameter_catalogue.h>

#include <fiberloom/fabric/fabric_parameters.h>
#include <fiberloom/fabric/fiber_set.h>
#include <fiberloom/fabric/tow_packing.h>

#include <boost/format.hpp>

#include <algorithm>
#include <cmath>

namespace fiberloom
{
  namespace
  {
    std::string
    short_text(const double value)
    {
      return (boost::format("%.2g") % value).str();
    }

    /** Of a file, which has a fabric only if it has its tows. */
    void
    check_stages(const Parameters &parameters, const FiberSet &fibers)
    {
      for (const std::string &stage : parameters.stages)
        if (!fibers.pattern && stage_type(stage).needs_fabric())
          throw InputError(
            parameters.where("Stages") + ": " + stage +
            " needs a fabric, but Fibers/File has no columns tow and family "
            "with warp and fill; allowed: " +
            stage_names(
              [](const StageType &type) { return !type.needs_fabric(); }) +
            ", or a file with them");
    }

    /** Before anything of the size of the grid is built. */
    void
    check_voxel_size(const Parameters &parameters, const FiberSet &fibers)
    {
      constexpr double most_voxels = 1e8;
      const double     size        = parameters.output.voxel_size;
      if (size == 0 || parameters.output.exports.empty())
        return;
      Vector3 low = Vector3::Constant(1e300), high = -low;
      double  thickness[2] = {0, 0}; // crossing tows start in each other
      for (const Fiber &fiber : fibers.fibers)
        for (const Vector3 &x :
             (fiber.initial ? fiber.initial->centers : fiber.centers))
          {
            const Vector3 radius = Vector3::Constant(fiber.radius);
            low                  = low.cwiseMin(x - radius);
            high                 = high.cwiseMax(x + radius);
          }
      for (const Tow &tow : fibers.tows)
        {
          double &largest = thickness[tow.family == Tow::Family::warp ? 0 : 1];
          largest         = std::max(largest, 2 * tow.half_thickness);
        }
      Vector3 box = high - low;
      box[2]      = std::max(box[2], thickness[0] + thickness[1]);
      if (const double n = box.prod() / (size * size * size); n > most_voxels)
        throw InputError(parameters.where("Output/Voxel size") + " = " +
                         exact_text(size) + ": the fabric would have some " +
                         short_text(n) + " voxels; allowed: at least some " +
                         short_text(std::cbrt(box.prod() / most_voxels)));
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
    check_voxel_size(parameters, fibers);
    parameters.stage_settings.check_fibers(parameters, fibers);
  }
} // namespace fiberloom
