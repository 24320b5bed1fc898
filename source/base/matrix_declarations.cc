// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/matrix_declarations.h>
#include <fiberloom/base/parameter_catalogue.h>
#include <fiberloom/base/parameters.h>

namespace fiberloom
{
  namespace
  {
    void
    declare_layers(ParameterCatalogue &catalogue, MatrixParameters &matrix)
    {
      catalogue.add("Layers",
                    matrix.layers,
                    "Where stage coat puts matrix: on the upper side, on the "
                    "lower one, on both, or filled, through the whole "
                    "thickness in one body.");
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
    catalogue.add("Law", matrix.law, "Elastic law for large strains.");
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
} // namespace fiberloom
