// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/parameter_catalogue.h>
#include <fiberloom/base/parameters.h>

#include <fiberloom/fabric/fiber_density.h>
#include <fiberloom/fabric/input_notes.h>
#include <fiberloom/fabric/usual_values.h>

#include <algorithm>
#include <string>
#include <vector>

namespace fiberloom
{
  namespace
  {
    const UsualRange radius_range{"a fiber",
                                  1e-4,
                                  1,
                                  "mm",
                                  {{"m", 1e3}, {"um", 1e-3}, {"nm", 1e-6}}},
      modulus_range{"a fiber", 500, 5e6, "MPa", {{"GPa", 1e3}, {"Pa", 1e-6}}},
      density_range{"a fiber",
                    1e-10,
                    3e-8,
                    "t/mm^3",
                    {{"g/cm^3", 1e-9}, {"kg/m^3", 1e-12}}};

    class Notes
    {
    public:
      explicit Notes(const Parameters &parameters)
        : parameters(parameters)
      {
        for (const std::string &note : parameters.notes)
          add(note);
      }

      /** The first of @p values that is unusual is told. */
      void
      check(const std::vector<double> &values,
            const UsualRange          &range,
            const std::string         &entry)
      {
        const auto unusual =
          std::find_if(values.begin(), values.end(), [&](const double value) {
            return !is_usual(value, range);
          });
        if (unusual != values.end())
          add(parameters.where(entry) + ": " +
              explain_unusual(*unusual, range));
      }

      void
      check_tows(const TowParameters &tows, const std::string &section)
      {
        check({tows.fiber_radius}, radius_range, section + "Fiber radius");
        check({tows.young_modulus}, modulus_range, section + "Young modulus");
        check({tows.density}, density_range, section + "Density");
      }

      void
      check_period(const WeavePattern &pattern)
      {
        // a plain weave has no middle of a period that would matter
        const FabricParameters &fabric = parameters.fabric;
        const unsigned int      period = pattern.period();
        if (period > 2 &&
            (fabric.warp.tows % period != 0 || fabric.fill.tows % period != 0))
          add(parameters.where("Fabric/Pattern") + " = " + fabric.pattern +
              " repeats after " + std::to_string(period) +
              " tows; the sample of " + std::to_string(fabric.warp.tows) +
              " warp and " + std::to_string(fabric.fill.tows) +
              " fill tows cuts it off in mid-period");
      }

      void
      check_fibers(const FiberSet &fibers)
      {
        for (const std::string &note : fibers.notes)
          add(note);
        if (parameters.fibers.file.empty())
          {
            check(parameters.fibers.radius, radius_range, "Fibers/Radius");
            check(parameters.fibers.young_modulus,
                  modulus_range,
                  "Fibers/Young modulus");
          }
        else
          {
            std::vector<double> radii, moduli;
            for (const Fiber &fiber : fibers.fibers)
              {
                radii.push_back(fiber.radius);
                moduli.push_back(fiber.young_modulus);
              }
            check(radii, radius_range, "Fibers/File");
            check(moduli, modulus_range, "Fibers/File");
          }
        check(parameters.fibers.density, density_range, "Fibers/Density");
      }

      /** Of a fabric; a modulus that is likely a mistake has a note of its own.
       */
      void
      check_areal_weight(const FiberSet &fibers, const std::string &entry)
      {
        for (const Fiber &fiber : fibers.fibers)
          if (!known_density(fiber) &&
              is_usual(fiber.young_modulus, modulus_range))
            return add(parameters.where(entry) +
                       " is not given, and a Young modulus of " +
                       exact_text(fiber.young_modulus) +
                       " MPa is not that of glass: the areal weight is left "
                       "out");
      }

      void
      check_stages()
      {
        for (const std::string &note :
             parameters.stage_settings.notes(parameters))
          add(note);
      }

      void
      tell_of_preview()
      {
        add(parameters.where("Accuracy") +
            " = preview: coarse fibers are woven roughly, without balance and "
            "without other stages or exports; nothing is claimed of accuracy");
      }

      std::vector<std::string>
      all() const
      {
        return notes;
      }

    private:
      const Parameters        &parameters;
      std::vector<std::string> notes;

      void
      add(const std::string &note)
      {
        notes.push_back("note: " + printable(note));
      }
    };
  } // namespace



  std::vector<std::string>
  input_notes(const Parameters &parameters, const FiberSet &fibers)
  {
    Notes notes(parameters);
    if (parameters.is_preview())
      notes.tell_of_preview();
    if (parameters.is_fabric())
      {
        notes.check_tows(parameters.fabric.warp, "Fabric/Warp/");
        if (!parameters.fabric.fill.same_as_warp)
          notes.check_tows(parameters.fabric.fill, "Fabric/Fill/");
        notes.check_period(*fibers.pattern);
      }
    else
      notes.check_fibers(fibers);
    notes.check_stages();
    if (fibers.pattern)
      notes.check_areal_weight(fibers,
                               parameters.is_fabric() ? "Fabric/Warp/Density" :
                                                        "Fibers/Density");
    return notes.all();
  }
} // namespace fiberloom
