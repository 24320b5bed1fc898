// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_beams_breakage_h
#define fiberloom_beams_breakage_h

#include <fiberloom/beams/fiber_mesh.h>

#include <vector>

namespace fiberloom
{
  /** Whether a fiber of @p fibers ever breaks. */
  bool
  can_break(const FiberSet &fibers);



  /**
   * Where fibers break: an element whose largest strain, see BeamElement, is
   * beyond its own. That is the breaking strain, or the strength s over
   * Young's modulus, which without a Weibull modulus is the same everywhere.
   * With one, m, an element of length l takes the law of the weakest link,
   *
   *   P(s) = 1 - exp(-(l/L0) (s/s0)^m),
   *
   * with the strength s0 of the reference length L0 (Weibull, "A statistical
   * distribution function of wide applicability", J. Appl. Mech. 18, 1951). A
   * whole fiber under even strain then follows the same law with its length.
   * What an element draws depends on seed, fiber and its number in the fiber
   * alone. Section 1.8 of the theory.
   */
  class Breakage
  {
  public:
    /**
     * Draws the breaking strain of each element; @p mesh is kept by reference.
     */
    Breakage(const FiberSet &fibers, const FiberMesh &mesh);

    /** Strain at which @p element breaks; infinite where it never does. */
    double
    breaking_strain(const unsigned int element) const
    {
      return strains[element];
    }

    /**
     * Breaks what does not hold at @p q , which is in balance: of each fiber
     * the element whose strain is most beyond its own. For elements of a fiber
     * are in series, and a break unloads the others; fibers are in parallel,
     * and a break loads the others more. Adds to @p history what breaks with
     * number, strain and place, and returns the elements; none where all holds.
     */
    std::vector<unsigned int>
    advance(const DofVector &q, FiberHistory &history) const;

  private:
    const FiberMesh    &mesh;
    std::vector<double> strains; // by element
  };
} // namespace fiberloom

#endif
