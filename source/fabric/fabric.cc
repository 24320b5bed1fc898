// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/parameter_catalogue.h>
#include <fiberloom/base/parameters.h>

#include <fiberloom/fabric/fiber_checks.h>
#include <fiberloom/fabric/fiber_set.h>
#include <fiberloom/fabric/tow_packing.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace fiberloom
{
  namespace
  {
    // for rounding in what the user computed by hand
    constexpr double tolerance = 1e-12;

    /** A bound to tell the user: few digits, and never below @p value . */
    std::string
    rounded_up(const double value)
    {
      std::ostringstream text;
      text << std::setprecision(6) << value * (1 + 1e-6);
      return text.str();
    }

    /** One family of tows, ready to be laid out. */
    struct Family
    {
      Tow::Family               name;
      std::string               section; // of the parameters
      const TowParameters      &tows;
      const TowParameters      &crossing;
      std::vector<SectionPoint> packing;                    // over the radius
      double                    half_width, half_thickness; // [mm]
      Vector3                   along, across;
      double                    cut; // of a cell, where it starts [mm]

      double
      half_length() const
      {
        return .5 * (crossing.tows - 1) * crossing.tow_spacing + tows.overhang;
      }
    };

    double
    half_extent(const std::vector<SectionPoint> &packing, const unsigned int d)
    {
      double largest = 0;
      for (const SectionPoint &point : packing)
        largest = std::max(largest, std::abs(point[d]));
      return largest + 1;
    }

    std::vector<SectionPoint>
    pack(const TowParameters &tows, const std::string &where)
    {
      try
        {
          return tow_packing(tows.layers.empty() ? default_layers(tows.fibers) :
                                                   tows.layers,
                             tows.fiber_spacing);
        }
      catch (const InputError &error)
        {
          throw InputError(where + ": " + error.what());
        }
    }

    Family
    make_family(const Tow::Family name, const Parameters &parameters)
    {
      const bool              is_warp = name == Tow::Family::warp;
      const FabricParameters &fabric  = parameters.fabric;
      const std::string    section = is_warp ? "Fabric/Warp/" : "Fabric/Fill/";
      const TowParameters &tows    = is_warp ? fabric.warp : fabric.fill;
      const std::vector<SectionPoint> packing =
        pack(tows, parameters.where(section + "Fiber spacing"));
      return {name,
              section,
              tows,
              is_warp ? fabric.fill : fabric.warp,
              packing,
              tows.fiber_radius * half_extent(packing, 0),
              tows.fiber_radius * half_extent(packing, 1),
              is_warp ? Vector3::UnitX() : Vector3::UnitY(),
              is_warp ? Vector3::UnitY() : Vector3::UnitX(),
              fabric.periodic ?
                fabric.cell_cut[is_warp ? 0 : 1] *
                  (is_warp ? fabric.fill : fabric.warp).tow_spacing :
                0};
    }

    /** Outer fibers of neighbours as far apart as fibers within a tow. */
    void
    check_spacing(const Family &family, const Parameters &parameters)
    {
      const TowParameters &tows = family.tows;
      const double         least =
        2 * family.half_width + (tows.fiber_spacing - 2) * tows.fiber_radius;
      if ((tows.tows > 1 || parameters.fabric.periodic) &&
          tows.tow_spacing < least * (1 - tolerance))
        throw InputError(parameters.where(family.section + "Tow spacing") +
                         " = " + exact_text(tows.tow_spacing) +
                         ": neighboring tows overlap; allowed: at least " +
                         rounded_up(least));
    }

    void
    check_overhang(const Family     &family,
                   const Family     &crossing,
                   const Parameters &parameters)
    {
      if (family.tows.overhang < crossing.half_width * (1 - tolerance))
        throw InputError(parameters.where(family.section + "Overhang") + " = " +
                         exact_text(family.tows.overhang) +
                         ": the tow ends inside the last crossing tow; "
                         "allowed: at least " +
                         rounded_up(crossing.half_width));
    }

    void
    check_tow(const Fiber      &fiber,
              const Family     &family,
              const Parameters &parameters)
    {
      try
        {
          check_proportions(fiber);
        }
      catch (const InputError &error)
        {
          throw InputError(
            parameters.where(family.section + "Tow spacing") +
            ", or Fiber radius, Overhang or Young modulus: " + error.what());
        }
    }

    Fiber
    straight_fiber(const Family      &family,
                   const unsigned int tow,
                   const Vector3     &middle)
    {
      const unsigned int n_nodes = 2 * family.tows.elements_per_fiber + 1;
      const double       half    = family.half_length();
      const Vector3      up      = Vector3::UnitZ();

      Fiber fiber;
      fiber.tow           = tow;
      fiber.radius        = family.tows.fiber_radius;
      fiber.young_modulus = family.tows.young_modulus;
      fiber.poisson_ratio = family.tows.poisson_ratio;
      fiber.density       = family.tows.density;
      fiber.law           = family.tows.axial_law;
      fiber.strength      = family.tows.strength;
      for (unsigned int n = 0; n < n_nodes; ++n)
        fiber.centers.push_back(
          middle +
          (half * (2. * n / (n_nodes - 1) - 1) + family.cut) * family.along);
      fiber.directions_1.assign(n_nodes, up.cross(family.along));
      fiber.directions_2.assign(n_nodes, up);
      return fiber;
    }

    /** Where a ply of a stack lies. */
    struct Ply
    {
      unsigned int number;
      unsigned int turns;  // by a quarter
      Vector3      origin; // [mm]
    };

    std::vector<Ply>
    make_plies(const FabricParameters      &fabric,
               const std::array<double, 2> &periods,
               const double                 distance)
    {
      std::vector<Ply> plies;
      for (unsigned int p = 0; p < fabric.plies; ++p)
        {
          Ply         ply{p, 0, Vector3(0, 0, p * distance)};
          const auto &shift = fabric.ply_shift;
          for (unsigned int d = 0; d < 2 && !shift.empty(); ++d)
            ply.origin[d] = periods[d] * (shift.size() == 2 ? p * shift[d] :
                                                              shift[2 * p + d]);
          if (!fabric.ply_rotation.empty())
            ply.turns = fabric.ply_rotation[p];
          plies.push_back(ply);
        }
      return plies;
    }

    /** Tows of a ply that run as @p family does once it is turned, in order
     * across. */
    void
    add_tows(const Family &family, const Ply &ply, FiberSet &set)
    {
      const TowParameters &tows = family.tows;
      const Matrix3        turn =
        Eigen::AngleAxisd(.5 * M_PI * ply.turns, Vector3::UnitZ())
          .toRotationMatrix()
          .array()
          .round();
      Family turned          = family;
      turned.along           = (turn * family.along).cwiseAbs();
      const Vector3 across   = turn * family.across;
      const bool    reversed = across.sum() < 0;
      turned.name =
        turned.along.x() > .5 ? Tow::Family::warp : Tow::Family::fill;
      unsigned int first = 0;
      for (const Tow &tow : set.tows)
        first += tow.family == turned.name;

      for (unsigned int k = 0; k < tows.tows; ++k)
        {
          const unsigned int original = reversed ? tows.tows - 1 - k : k;
          Tow                tow;
          tow.family = turned.name;
          tow.number = first + k;
          tow.ply    = ply.number;
          const double place =
            (original - .5 * (tows.tows - 1)) * tows.tow_spacing;
          Vector3 origin = place * across + ply.origin;
          // Into the cell, whose images reach as far as one period.
          if (set.cell)
            for (unsigned int d = 0; d < 2; ++d)
              origin[d] = std::remainder(origin[d], (*set.cell)[d]);
          tow.center         = origin.dot(across.cwiseAbs());
          tow.half_width     = family.half_width;
          tow.half_thickness = family.half_thickness;
          for (const SectionPoint &point : family.packing)
            {
              tow.fibers.push_back(set.fibers.size());
              set.fibers.push_back(
                straight_fiber(turned,
                               set.tows.size(),
                               origin + point[0] * tows.fiber_radius * across +
                                 point[1] * tows.fiber_radius *
                                   Vector3::UnitZ()));
            }
          set.tows.push_back(tow);
        }
    }

    /** A cell holds whole periods of the weave. */
    void
    check_periods(const WeavePattern &pattern, const Parameters &parameters)
    {
      for (const bool is_warp : {true, false})
        {
          const FabricParameters &fabric  = parameters.fabric;
          const std::string       section = is_warp ? "Warp" : "Fill";
          const unsigned int      tows =
            is_warp ? fabric.warp.tows : fabric.fill.tows;
          if (pattern.period() > 0 && tows % pattern.period() != 0)
            throw InputError(
              parameters.where("Fabric/" + section + "/Tows") + " = " +
              std::to_string(tows) + ": a periodic cell holds whole periods; " +
              "allowed: multiples of " + std::to_string(pattern.period()) +
              " for " + fabric.pattern);
        }
    }

    WeavePattern
    make_pattern(const Parameters &parameters)
    {
      const FabricParameters &fabric = parameters.fabric;
      try
        {
          return WeavePattern(fabric.pattern,
                              fabric.warp.tows,
                              fabric.fill.tows);
        }
      catch (const InputError &error)
        {
          throw InputError(parameters.where("Fabric/Pattern") + ": " +
                           error.what());
        }
    }
  } // namespace

  FiberSet
  build_fabric(const Parameters &parameters)
  {
    FiberSet set;
    set.pattern = make_pattern(parameters);
    if (const FabricParameters &fabric = parameters.fabric; fabric.periodic)
      {
        check_periods(*set.pattern, parameters);
        set.cell =
          std::array<double, 2>{{fabric.fill.tows * fabric.fill.tow_spacing,
                                 fabric.warp.tows * fabric.warp.tow_spacing}};
      }

    const Family warp = make_family(Tow::Family::warp, parameters);
    const Family fill = make_family(Tow::Family::fill, parameters);
    check_spacing(warp, parameters);
    check_spacing(fill, parameters);
    check_overhang(warp, fill, parameters);
    check_overhang(fill, warp, parameters);

    const double woven = 2 * (warp.half_thickness + fill.half_thickness);
    const auto   plies = make_plies(parameters.fabric,
                                  set.cell.value_or(std::array<double, 2>()),
                                  2 * woven);
    for (const bool along_x : {true, false})
      for (const Ply &ply : plies)
        add_tows(along_x == (ply.turns % 2 == 0) ? warp : fill, ply, set);
    if (plies.size() > 1)
      {
        std::vector<WeavePattern> patterns;
        for (const Ply &ply : plies)
          {
            patterns.push_back(*set.pattern);
            for (unsigned int n = 0; n < ply.turns; ++n)
              patterns.back() = patterns.back().turned();
          }
        set.pattern = WeavePattern(patterns);
      }
    for (const Tow &tow : set.tows)
      check_tow(set.fibers[tow.fibers[0]],
                tow.family == Tow::Family::warp ? warp : fill,
                parameters);
    return set;
  }

  FiberSet
  build_fiber_set(const Parameters &parameters)
  {
    return parameters.is_fabric() ? build_fabric(parameters) :
                                    build_fibers(parameters);
  }
} // namespace fiberloom
