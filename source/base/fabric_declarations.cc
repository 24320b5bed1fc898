// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/fabric_declarations.h>
#include <fiberloom/base/parameter_catalogue.h>
#include <fiberloom/base/parameters.h>

#include <limits>

namespace fiberloom
{
  namespace
  {
    // bounds that keep a slip of the finger from filling the memory
    constexpr int most_tows = 1000, most_fibers = 10000, most_plies = 100,
                  most_elements = TowParameters::most_elements;

    void
    declare_axial_law(ParameterCatalogue &catalogue, AxialLaw &axial_law)
    {
      catalogue.add(
        "Axial law",
        axial_law,
        "Law of the axial force: that of the solid, which grows by 1.5 % "
        "more than the stretch at a strain of 1 %, or linear in the stretch, "
        "as in theories of rods.");
    }

    void
    declare_strength(ParameterCatalogue &catalogue,
                     StrengthParameters &strength)
    {
      catalogue.add("Breaking strain",
                    strength.breaking_strain,
                    "Largest strain along the fiber, bending included, at "
                    "which an element of it breaks. 0: by the strength, and "
                    "without one never.",
                    Allowed::at_least(0));
      catalogue.add("Strength",
                    strength.strength,
                    "In place of that the stress at which it breaks, Young's "
                    "modulus times the strain [MPa]; with a Weibull modulus "
                    "that of which 1/e of the fibers of the reference length "
                    "hold more. 0: by the breaking strain.",
                    Allowed::at_least(0));
      catalogue.add("Weibull modulus",
                    strength.weibull_modulus,
                    "How little strengths differ from element to element, 3 "
                    "to 10 for glass and carbon. 0: not at all.",
                    Allowed::from_to(0, 1000));
      catalogue.add("Reference length",
                    strength.reference_length,
                    "Length of fiber of which that is the strength [mm], for "
                    "a Weibull modulus.",
                    Allowed::at_least(0));
      catalogue.add("Strength seed",
                    strength.seed,
                    "Another number draws other strengths.",
                    Allowed::whole(0, std::numeric_limits<int>::max()));
    }

    void
    declare_material(ParameterCatalogue &catalogue,
                     double             &young_modulus,
                     double             &poisson_ratio,
                     double             &density)
    {
      catalogue.add("Young modulus",
                    young_modulus,
                    "Young's modulus of the fibers [MPa].",
                    Allowed::above(0));
      catalogue.add("Poisson ratio",
                    poisson_ratio,
                    "Poisson's ratio of the fibers.",
                    Allowed::from_to_below(0, .5));
      catalogue.add("Density",
                    density,
                    "Density of the fibers [t/mm^3], such as 2.55e-9 for "
                    "glass; for Load/Gravity and the areal weight. 0: no "
                    "weight for gravity; the areal weight is that of glass "
                    "where Young's modulus is, from 65 to 95 GPa.",
                    Allowed::at_least(0));
    }

    void
    declare_arrangements(ParameterCatalogue &catalogue,
                         FibersParameters   &fibers)
    {
      catalogue.enter_section("Bundle");
      catalogue.add("Fibers",
                    fibers.bundle.fibers,
                    "Number of fibers: a whole hexagon, 1, 7, 19, 37, 61 ... "
                    "Number 0 is the one in the middle, the others follow "
                    "ring by ring.",
                    Allowed::whole(1, most_fibers));
      catalogue.add("Length",
                    fibers.bundle.length,
                    "Length of the fibers [mm].",
                    Allowed::above(0));
      catalogue.add("Spacing",
                    fibers.bundle.spacing,
                    "Distance between the axes of neighbors, over the fiber "
                    "radius.",
                    Allowed::at_least(2));
      catalogue.leave_section();

      catalogue.enter_section("Strand");
      catalogue.add("Outer fibers",
                    fibers.strand.outer_fibers,
                    "Number of helices around the core, which is fiber 0.",
                    Allowed::whole(1, most_fibers));
      catalogue.add("Length",
                    fibers.strand.length,
                    "Length of the core [mm].",
                    Allowed::above(0));
      catalogue.add("Lay angle",
                    fibers.strand.lay_angle,
                    "Angle of the helices to the core [rad]; negative: "
                    "left-handed. 0: by the lay length.",
                    Allowed::from_to(-1.5, 1.5));
      catalogue.add("Lay length",
                    fibers.strand.lay_length,
                    "Length of the core for one turn of the helices [mm]; "
                    "negative: left-handed. 0: by the lay angle.",
                    Allowed::any_number());
      catalogue.leave_section();
    }

    void
    declare_tows(ParameterCatalogue &catalogue, TowParameters &tows)
    {
      catalogue.add("Tows",
                    tows.tows,
                    "Number of tows of the sample in this direction.",
                    Allowed::whole(1, most_tows));
      catalogue.add("Fibers per tow",
                    tows.fibers,
                    "Number of fibers of each tow.",
                    Allowed::whole(1, most_fibers));
      catalogue.add("Layers",
                    tows.layers,
                    "Numbers of fibers of the layers of a tow, bottom to top; "
                    "each layer is staggered over the one below. Empty: a flat "
                    "hexagon.",
                    Allowed::list_of(Allowed::whole(1, most_fibers)));
      catalogue.add("Fiber radius",
                    tows.fiber_radius,
                    "Radius of the round fibers [mm].",
                    Allowed::above(0));
      catalogue.add("Fiber spacing",
                    tows.fiber_spacing,
                    "Distance between the axes of neighboring fibers of a tow, "
                    "over the fiber radius; at least 2.",
                    Allowed::above(0));
      catalogue.add("Tow spacing",
                    tows.tow_spacing,
                    "Distance between the axes of neighboring tows [mm].",
                    Allowed::above(0));
      catalogue.add("Overhang",
                    tows.overhang,
                    "Length of the tows beyond the axis of the last crossing "
                    "tow, at both ends [mm]. 0: half the spacing of the "
                    "crossing tows.",
                    Allowed::at_least(0));
      declare_material(catalogue,
                       tows.young_modulus,
                       tows.poisson_ratio,
                       tows.density);
      declare_axial_law(catalogue, tows.axial_law);
      declare_strength(catalogue, tows.strength);
      catalogue.add(
        "Elements per fiber",
        tows.elements_per_fiber,
        "Number of quadratic beam elements along each fiber. 0: "
        "by the accuracy, some 4 (draft), 6 (standard) or 10 (fine) "
        "per crossing tow.",
        Allowed::whole(0, most_elements));
    }
  } // namespace



  void
  declare_fabric(ParameterCatalogue &catalogue, FabricParameters &fabric)
  {
    catalogue.enter_section("Fabric");
    catalogue.add("Pattern",
                  fabric.pattern,
                  "Which tow lies above at each crossing. Rows stand for the "
                  "fill tows, with one digit for each warp tow: 1 where the "
                  "warp tow is above, 0 where it is below, such as 1010 0101 "
                  "for two fill tows and four warp tows.",
                  Allowed::text_like(
                    "plain, twill 2/2, twill 3/1, twill 1/3, satin 5, "
                    "satin 8, or rows of 0 and 1 with blanks or / between"));
    catalogue.add("Periodic",
                  fabric.periodic,
                  "Whether the tows are a cell of an endless fabric, one or "
                  "more periods of the pattern without tow ends, whose "
                  "period is the number of tows times their spacing.",
                  Allowed::true_or_false());
    catalogue.add("Cell cut",
                  fabric.cell_cut,
                  "Where a periodic cell cuts its warp and its fill tows, "
                  "from the middle between two tows that cross, over the "
                  "spacing of these. Results do not depend on it.",
                  Allowed::list_of(Allowed::from_to(-.5, .5), 2));
    catalogue.add("Plies",
                  fabric.plies,
                  "Copies of the fabric in a stack, each woven by itself; of "
                  "a periodic cell.",
                  Allowed::whole(1, most_plies));
    catalogue.add("Ply shift",
                  fabric.ply_shift,
                  "Where plies lie along warp and fill, over the periods: two "
                  "numbers, by which each ply is shifted against the one "
                  "below, or two for each ply. Empty: straight above each "
                  "other.",
                  Allowed::list_of(Allowed::from_to(-1, 1)));
    catalogue.add("Ply rotation",
                  fabric.ply_rotation,
                  "Quarter turns of each ply, the lowest first; of a square "
                  "cell. Empty: none.",
                  Allowed::list_of(Allowed::whole(0, 3)));
    catalogue.enter_section("Warp");
    declare_tows(catalogue, fabric.warp);
    catalogue.leave_section();
    catalogue.enter_section("Fill");
    catalogue.add("Same as warp",
                  fabric.fill.same_as_warp,
                  "Takes every entry of the fill tows that is not given from "
                  "the warp tows.",
                  Allowed::true_or_false());
    declare_tows(catalogue, fabric.fill);
    catalogue.leave_section();
    catalogue.leave_section();
  }



  void
  declare_fibers(ParameterCatalogue &catalogue, FibersParameters &fibers)
  {
    catalogue.enter_section("Fibers");
    catalogue.add("Polylines",
                  fibers.polylines,
                  "Fibers that are no fabric: the axis of each as a line "
                  "through points [mm]. If fibers are given by this entry, "
                  "File, Curves or Arrangement, there is no fabric.",
                  Allowed::text_like("points x y z with commas between, "
                                     "fibers with semicolons between"));
    catalogue.add("File",
                  fibers.file,
                  "File with the axes of the fibers [mm], taken relative to "
                  "the directory of this file: a table with the columns "
                  "fiber, x, y, z and, if wanted, radius, young_modulus, "
                  "poisson_ratio, tow and family, which make a fabric, or "
                  "lines of VTK with the names of values as data of points "
                  "or cells.",
                  Allowed::text_like("a file .csv, .vtp or .vtu"));
    catalogue.add("Curves",
                  fibers.curves,
                  "The axes as functions x; y; z [mm] of s, which goes from "
                  "0 to 1 along the fiber, and i, the number of the fiber "
                  "of this curve, from 0.",
                  Allowed::text_like("three functions of s and i with "
                                     "semicolons between, curves with | "
                                     "between"));
    catalogue.add("Fibers per curve",
                  fibers.fibers_per_curve,
                  "Number of fibers of every curve, or of each.",
                  Allowed::list_of(Allowed::whole(1, most_fibers), 1));
    catalogue.add("Arrangement",
                  fibers.arrangement,
                  "Fibers arranged along the axis x, their middle in the "
                  "origin: a straight hexagonal bundle, or a strand of a "
                  "core and helices around it that touch it.");
    declare_arrangements(catalogue, fibers);
    catalogue.add("Interpolation",
                  fibers.interpolation,
                  "What joins points of polylines and of files: straight "
                  "lines or a smooth curve. automatic: straight for "
                  "polylines, smooth for files.");
    catalogue.add("Stress free",
                  fibers.stress_free,
                  "Shape without stress: as given, or straight; then a "
                  "fiber that is given curved starts with the stresses of "
                  "its bending.");
    const std::string groups =
      " One number for all, or one for each polyline or curve, or those of "
      "the core and of the outer fibers of a strand; values in a file of "
      "fibers come first.";
    catalogue.add("Radius",
                  fibers.radius,
                  "Radius of the round fibers [mm]." + groups,
                  Allowed::list_of(Allowed::above(0), 1));
    catalogue.add("Young modulus",
                  fibers.young_modulus,
                  "Young's modulus of the fibers [MPa]; several as for "
                  "Radius.",
                  Allowed::list_of(Allowed::above(0), 1));
    catalogue.add("Poisson ratio",
                  fibers.poisson_ratio,
                  "Poisson's ratio of the fibers; several as for Radius.",
                  Allowed::list_of(Allowed::from_to_below(0, .5), 1));
    catalogue.add("Density",
                  fibers.density,
                  "Density of the fibers [t/mm^3], as that of tows; several "
                  "as for Radius.",
                  Allowed::list_of(Allowed::at_least(0), 1));
    declare_axial_law(catalogue, fibers.axial_law);
    declare_strength(catalogue, fibers.strength);
    catalogue.add("Elements per fiber",
                  fibers.elements_per_fiber,
                  "Number of quadratic beam elements along each fiber. 0: by "
                  "the accuracy, 8 (draft), 16 (standard) or 32 (fine).",
                  Allowed::whole(0, most_elements));
    catalogue.leave_section();
  }
} // namespace fiberloom
