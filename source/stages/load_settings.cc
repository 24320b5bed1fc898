// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/parameter_catalogue.h>
#include <fiberloom/base/parameters.h>
#include <fiberloom/base/vector_function.h>

#include <fiberloom/fabric/fiber_points.h>

#include <fiberloom/stages/load_settings.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <array>
#include <map>

namespace fiberloom
{
  namespace
  {
    // Points of the load at which functions are looked at, and at which they
    // must be finite; what is between is found where an increment ends there.
    constexpr unsigned int n_samples = 200, n_finite = 2000;

    using Components = std::array<bool, 3>;

    /** Three functions of t that are finite from 0 to @p end . Throws
     * InputError. */
    VectorFunction
    read_functions(const std::string &functions,
                   const double       end,
                   const std::string &where)
    {
      const std::string allowed = "; allowed: three functions of t with "
                                  "semicolons between, such as 0; 0; 0.1*t";
      const std::size_t n =
        dealii::Utilities::split_string_list(functions, ';').size();
      if (n != 3)
        throw InputError(where + ": " + std::to_string(n) + " functions" +
                         allowed);
      try
        {
          VectorFunction parsed(functions);
          for (unsigned int i = 0; i <= (parsed.is_constant() ? 0 : n_finite);
               ++i)
            if (!parsed.value(end * i / n_finite).allFinite())
              throw InputError("not finite at t = " +
                               exact_text(end * i / n_finite));
          return parsed;
        }
      catch (const InputError &error)
        {
          throw InputError(where + " = " + functions + ": " + error.what() +
                           allowed);
        }
    }

    /** Which of the components are not always 0. */
    Components
    nonzero_components(const VectorFunction &function, const double end)
    {
      Components nonzero{{false, false, false}};
      for (unsigned int i = 0; i <= n_samples; ++i)
        for (unsigned int c = 0; c < 3; ++c)
          nonzero[c] =
            nonzero[c] || function.value(end * i / n_samples)[c] != 0;
      return nonzero;
    }

    bool
    is_zero(const VectorFunction &function, const double end)
    {
      return nonzero_components(function, end) == Components();
    }

    void
    check_starts_at_zero(const VectorFunction &motion, const std::string &where)
    {
      if (motion.value(0).norm() > 1e-12)
        throw InputError(where +
                         ": it is not 0 at t = 0; allowed: the motion relative "
                         "to the start of the stage, such as 0; 0; 0.1*t");
    }

    /** Turns can be followed. */
    void
    check_turns(const VectorFunction &rotation,
                const LoadSettings   &load,
                const std::string    &where)
    {
      if (!(rotation.step_within(LoadSettings::largest_turn,
                                 load.largest_step,
                                 load.end) > 0))
        throw InputError(where + ": it jumps by more than 15 degrees; "
                                 "allowed: functions without jumps");
    }

    /** That all names are those of choices; a wrong one @p is_wrong , in
     * words. */
    template <class Choice>
    void
    check_names(const NamedSet<Choice> &names,
                const std::string      &is_wrong,
                const std::string      &where)
    {
      if (names.unknown_name())
        throw InputError(where + ": " + *names.unknown_name() + " " + is_wrong +
                         "; allowed: " + all_names<Choice>(", ") +
                         " with blanks between");
    }

    void
    check_center(const GivenPoint &center, const std::string &where)
    {
      if (center.is_wrong())
        throw InputError(where + " = " + center.text() +
                         " is no point; allowed: three numbers x y z with "
                         "blanks between");
    }

    void
    check_borders(const DriveParameters &drive, const Parameters &parameters)
    {
      const std::string section = "Drive " + drive.name + "/";
      if (const auto &name = drive.matrix_borders.unknown_name())
        throw InputError(parameters.where(section + "Matrix borders") +
                         ": there is no border " + *name +
                         "; allowed: " + all_names<MatrixBorder>(", ") +
                         " with commas between");
      if (!drive.matrix_borders.empty() && !parameters.has_matrix())
        throw InputError(parameters.where(section + "Matrix borders") +
                         ": the scene has no matrix; allowed: another "
                         "Matrix/Layers than none");
      check_names(drive.matrix_held,
                  "cannot be held",
                  parameters.where(section + "Matrix held"));
    }

    /** Motion where it is free or load where it is not would be ignored. */
    void
    check_drive(const DriveParameters &drive,
                const LoadSettings    &load,
                const Parameters      &parameters)
    {
      const std::string section = "Drive " + drive.name + "/";
      check_borders(drive, parameters);
      if (drive.ends.empty() && drive.matrix_borders.empty())
        throw InputError(parameters.where(section + "Ends") +
                         ": no end is named; allowed: a list such as 0 start, "
                         "3-5 end, all at 0.5");
      check_names(drive.held,
                  "cannot be held",
                  parameters.where(section + "Held"));
      check_center(drive.center, parameters.where(section + "Center"));
      check_names(drive.free,
                  "is no degree of freedom",
                  parameters.where(section + "Free"));

      struct Quantity
      {
        std::string            name;
        const std::string     &functions;
        std::array<BodyDof, 3> dofs;
        bool                   acts_on_free;
      };
      const std::array<BodyDof, 3> along{{BodyDof::x, BodyDof::y, BodyDof::z}},
        about{{BodyDof::rx, BodyDof::ry, BodyDof::rz}};
      for (const Quantity &quantity :
           {Quantity{"Translation", drive.translation, along, false},
            Quantity{"Rotation", drive.rotation, about, false},
            Quantity{"Force", drive.force, along, true},
            Quantity{"Moment", drive.moment, about, true}})
        {
          const std::string where = parameters.where(section + quantity.name);
          const VectorFunction function =
            read_functions(quantity.functions, load.end, where);
          const Components given = nonzero_components(function, load.end);
          for (unsigned int i = 0; i < 3; ++i)
            {
              const BodyDof dof     = quantity.dofs[i];
              const bool    is_free = drive.free.has(dof);
              if (given[i] && is_free != quantity.acts_on_free)
                throw InputError(where + ": " + name_of(dof) + " is " +
                                 (is_free ? "" : "not ") +
                                 "free; allowed: 0 as function number " +
                                 std::to_string(i + 1) + ", or another entry " +
                                 section + "Free");
            }
          if (!quantity.acts_on_free)
            check_starts_at_zero(function, where);
          if (quantity.name == "Rotation")
            check_turns(function, load, where);
        }
    }

    void
    check_distributed_loads(const LoadSettings &load,
                            const Parameters   &parameters)
    {
      read_functions(load.line_load,
                     load.end,
                     parameters.where("Load/Line load"));
      const std::string where = parameters.where("Load/Gravity");
      const bool        heavy =
        parameters.is_fabric() ?
                 parameters.fabric.warp.density + parameters.fabric.fill.density > 0 :
                 *std::max_element(parameters.fibers.density.begin(),
                            parameters.fibers.density.end()) > 0;
      if (!is_zero(read_functions(load.gravity, load.end, where), load.end) &&
          !heavy)
        throw InputError(where + ": the fibers have no weight; allowed: " +
                         (parameters.is_fabric() ? "Fabric/Warp/" : "Fibers/") +
                         "Density above 0");
    }

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
  } // namespace



  void
  LoadSettings::declare(ParameterCatalogue &catalogue)
  {
    const Allowed functions =
      Allowed::text_like("three functions of t with semicolons between");
    catalogue.enter_section("Load");
    catalogue.add("End",
                  end,
                  "Where t, which starts at 0, ends. An increment ends at "
                  "each whole t, so that phases of a test can be given as "
                  "0 to 1, 1 to 2 ...",
                  Allowed::from_to(1e-3, 1e3));
    catalogue.add("First step",
                  first_step,
                  "First increment of t; never more than the largest step.",
                  Allowed::from_to(1e-6, 1e3));
    catalogue.add("Largest step",
                  largest_step,
                  "Largest increment of t. No increment turns a drive by "
                  "more than 15 degrees.",
                  Allowed::from_to(1e-6, 1e3));
    catalogue.add("Line load",
                  line_load,
                  "Dead load along the fibers [N/mm of stress-free length].",
                  functions);
    catalogue.add("Gravity",
                  gravity,
                  "Acceleration of gravity [mm/s^2], such as 0; 0; -9810; "
                  "the weight is that of Density.",
                  functions);
    catalogue.add("Loaded fibers",
                  loaded_fibers,
                  "Fibers that Line load and Gravity act on.",
                  Allowed::text_like("such as all, 0, 3-5, warp, fill 0-2"));
    catalogue.add("Probes",
                  probes,
                  "Points of fibers whose positions get columns in the "
                  "loading curve.",
                  Allowed::text_like("such as 0 end, 3 at 0.5, all at 0.5"));
    catalogue.leave_section();
  }



  void
  LoadSettings::resolve(const Parameters &)
  {
    first_step = std::min(first_step, largest_step);
  }



  void
  LoadSettings::check(const Parameters &parameters) const
  {
    for (const DriveParameters &drive : parameters.drives)
      check_drive(drive, *this, parameters);
    check_distributed_loads(*this, parameters);
  }



  void
  LoadSettings::check_fibers(const Parameters &parameters,
                             const FiberSet   &fibers) const
  {
    check_drive_ends(parameters, fibers);
    found_at(parameters, "Load/Loaded fibers", [&]() {
      return find_fibers(loaded_fibers, fibers);
    });
    found_at(parameters, "Load/Probes", [&]() {
      return find_points(probes, fibers);
    });
  }
} // namespace fiberloom
