// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/composite_declarations.h>
#include <fiberloom/base/parameter_catalogue.h>
#include <fiberloom/base/parameters.h>

namespace fiberloom
{
  namespace
  {
    void
    declare_turning(ParameterCatalogue &catalogue,
                    double             &largest_angle,
                    double             &first_step,
                    double             &largest_step)
    {
      catalogue.add("Largest angle",
                    largest_angle,
                    "Angle at the end of the test, or where Way is 1 [rad].",
                    Allowed::from_to(1e-9, 3));
      catalogue.add(
        "First step",
        first_step,
        "First increment of the angle, and of each leg of Way [rad]; "
        "never more than the largest step.",
        Allowed::from_to(1e-9, 1));
      catalogue.add("Largest step",
                    largest_step,
                    "Largest increment of the angle [rad].",
                    Allowed::from_to(1e-9, .26));
    }

    void
    declare_layers(ParameterCatalogue &catalogue, MatrixParameters &matrix)
    {
      catalogue.add("Layers",
                    matrix.layers,
                    "Where stage coat puts matrix: on the upper side, on the "
                    "lower one, on both, or filled, through the whole "
                    "thickness in one body.",
                    Allowed::one_of("none|upper|lower|both|filled"));
      catalogue.add("Thickness",
                    matrix.thickness,
                    "Of a layer beyond the outermost skin of the fibers, where "
                    "its outer face lies flat [mm]; more than the overlap. 0: "
                    "six times the largest fiber radius.",
                    Allowed::from_to(0, farthest));
      catalogue.add("Overlap",
                    matrix.overlap,
                    "How deep the inner face lies below the woven surface "
                    "[mm], of two layers at most 0.45 of the fabric's "
                    "thickness there. 0: the largest fiber radius.",
                    Allowed::from_to(0, farthest));
      catalogue.add("Size along x",
                    matrix.size_x,
                    "Length of the layers [mm], about the middle of the "
                    "fibers; 0: as long as these.",
                    Allowed::from_to(0, farthest));
      catalogue.add("Size along y",
                    matrix.size_y,
                    "Width of the layers [mm]; 0: as wide as the fibers.",
                    Allowed::from_to(0, farthest));
      catalogue.add("Cells along x",
                    matrix.cells_along_x,
                    "Number of cells. 0: two a tow that is crossed, or 8 where "
                    "there is no fabric.",
                    Allowed::whole(0, 1000));
      catalogue.add("Cells along y",
                    matrix.cells_along_y,
                    "The same.",
                    Allowed::whole(0, 1000));
      catalogue.add("Cells through thickness",
                    matrix.cells_through_thickness,
                    "Of each layer.",
                    Allowed::whole(1, 100));
      catalogue.add("Degree",
                    matrix.degree,
                    "Of the polynomials in a cell: 1 or 2. Cells of degree 1 "
                    "are too stiff in bending unless there are several "
                    "through the thickness.",
                    Allowed::whole(1, 2));
    }
  } // namespace



  void
  declare_matrix(ParameterCatalogue &catalogue, MatrixParameters &matrix)
  {
    catalogue.enter_section("Matrix");
    declare_layers(catalogue, matrix);
    catalogue.add("Law",
                  matrix.law,
                  "Elastic law for large strains.",
                  Allowed::one_of("Saint Venant-Kirchhoff|neo-Hooke"));
    catalogue.add("Young modulus",
                  matrix.young_modulus,
                  "Young's modulus of the matrix [MPa].",
                  Allowed::above(0));
    catalogue.add("Poisson ratio",
                  matrix.poisson_ratio,
                  "Poisson's ratio of the matrix.",
                  Allowed::from_to_below(0, .5));
    catalogue.add("Junction spacing",
                  matrix.junction_spacing,
                  "Distance of junctions along a fiber [mm]. 0: half an "
                  "element.",
                  Allowed::at_least(0));
    catalogue.add("Junction stiffness",
                  matrix.junction_stiffness,
                  "Of the junctions, per length of fiber [MPa]. 0: 2 pi G / "
                  "ln(R/r) of the matrix's shear modulus G.",
                  Allowed::at_least(0));
    catalogue.add("Junction reach",
                  matrix.junction_reach,
                  "R/r in that formula: distance from a fiber's axis at "
                  "which the matrix does not notice it, over the radius.",
                  Allowed::above(1));
    catalogue.leave_section();
  }



  void
  declare_way(ParameterCatalogue  &catalogue,
              std::vector<double> &way,
              const std::string   &whole,
              const int            lowest)
  {
    catalogue.add("Way",
                  way,
                  "Points between which the test goes to and fro, beginning at "
                  "0, as parts of " +
                    whole +
                    ": 1, 0, 1, 0 are two cycles of loading and unloading.",
                  Allowed::list_of(Allowed::from_to(lowest, 1), 1));
  }



  void
  declare_shear(ParameterCatalogue &catalogue, ShearParameters &shear)
  {
    catalogue.enter_section("Shear");
    declare_turning(catalogue,
                    shear.largest_angle,
                    shear.first_step,
                    shear.largest_step);
    declare_way(catalogue, shear.way, "the largest angle", -1);
    catalogue.leave_section();
  }

  void
  declare_bend(ParameterCatalogue &catalogue, BendParameters &bend)
  {
    catalogue.enter_section("Bending");
    catalogue.add("Direction",
                  bend.direction,
                  "Family of tows that is bent: its two borders turn against "
                  "each other.",
                  Allowed::one_of("warp|fill"));
    declare_turning(catalogue,
                    bend.largest_angle,
                    bend.first_step,
                    bend.largest_step);
    declare_way(catalogue, bend.way, "the largest angle", -1);
    catalogue.leave_section();
  }
} // namespace fiberloom
