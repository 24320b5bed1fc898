// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_fabric_fiber_set_h
#define fiberloom_fabric_fiber_set_h

#include <fiberloom/base/choices.h>
#include <fiberloom/base/strength_parameters.h>
#include <fiberloom/base/vector_types.h>

#include <fiberloom/fabric/weave_pattern.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace fiberloom
{
  struct Parameters;

  /** Nodes of a fiber, and the two unit section vectors at each. */
  struct FiberPlacement
  {
    std::vector<Vector3> centers; // [mm]
    std::vector<Vector3> directions_1;
    std::vector<Vector3> directions_2;
  };

  /**
   * One fiber as the user described it: a stress-free centre line through
   * 2 n_elements + 1 nodes with the two unit section vectors at each, a round
   * section and an isotropic material.
   */
  struct Fiber
  {
    unsigned int tow;           // index into FiberSet::tows
    double       radius;        // [mm]
    double       young_modulus; // [MPa]
    double       poisson_ratio;

    std::vector<Vector3> centers; // [mm]
    std::vector<Vector3> directions_1;
    std::vector<Vector3> directions_2;

    std::optional<FiberPlacement> initial  = {}; // if it starts under stress
    double                        density  = 0;  // [t/mm^3]
    AxialLaw                      law      = AxialLaw::saint_venant_kirchhoff;
    StrengthParameters            strength = {};

    unsigned int
    n_elements() const
    {
      return (centers.size() - 1) / 2;
    }
  };

  /** Fibers that are handled together. Fibers that are no fabric are tows of
   * one. */
  struct Tow
  {
    enum class Family
    {
      warp, // runs along x
      fill, // runs along y
      none
    };

    Family       family;
    unsigned int number; // within the family, through all plies
    double
      center; // position across the tow: y of a warp tow, x of a fill tow [mm]
    double                    half_width;     // [mm], fiber surfaces included
    double                    half_thickness; // [mm], fiber surfaces included
    std::vector<unsigned int> fibers;
    unsigned int              ply = 0; // the lowest is 0
  };

  /** What is simulated, as pure geometry. */
  struct FiberSet
  {
    unsigned int
    n_plies() const
    {
      return tows.empty() ? 0 : tows.back().ply + 1;
    }

    std::vector<Fiber>          fibers; // fibers of one tow are consecutive
    std::vector<Tow>            tows;   // warp tows, then fill tows
    std::optional<WeavePattern> pattern;
    std::vector<std::string>    notes = {}; // for the user, of what was read

    // Periods along x and y [mm] of a cell of a fabric without tow ends: the
    // last node of each fiber is the image of its first one.
    std::optional<std::array<double, 2>> cell = {};
  };

  /**
   * The flat fabric before weaving: straight tows, all on the plane z = 0, so
   * that crossing tows interpenetrate (figure 8 of the paper). Warp along x,
   * fill along y, sample centred at the origin; the first section vector of
   * every fiber is horizontal and across the fiber, the second vertical.
   * Plies of a stack lie so far above each other that they do not touch when
   * they are woven, and are numbered with all their tows, warp tows first.
   * Throws InputError for tows that overlap their neighbours, and for a cell of
   * no whole periods.
   */
  FiberSet
  build_fabric(const Parameters &parameters);

  /**
   * The fibers of section Fibers with nodes at equal distances and sections
   * that do not twist, stress-free as they are given or straight. Throws
   * InputError.
   */
  FiberSet
  build_fibers(const Parameters &parameters);

  /**
   * The fibers of a fabric or of section Fibers, whichever the parameters
   * describe. Throws InputError.
   */
  FiberSet
  build_fiber_set(const Parameters &parameters);
} // namespace fiberloom

#endif
