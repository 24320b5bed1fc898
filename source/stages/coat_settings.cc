// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/parameter_catalogue.h>
#include <fiberloom/base/parameters.h>

#include <fiberloom/fabric/usual_values.h>

#include <fiberloom/stages/coat_settings.h>

#include <algorithm>

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
      catalogue.add(
        "Thickness",
        matrix.thickness,
        "Height of a layer's flat outer face above the outermost skin of the "
        "fibers [mm]; more than the overlap. 0: six times the largest fiber "
        "radius.",
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
                    "Number of cells along y, as along x.",
                    Allowed::whole(0, 1000));
      catalogue.add("Cells through thickness",
                    matrix.cells_through_thickness,
                    "Number of cells through each layer.",
                    Allowed::whole(1, 100));
      catalogue.add("Degree",
                    matrix.degree,
                    "Degree of the polynomials in a cell. Cells of degree 1 "
                    "are too stiff in bending unless there are several "
                    "through the thickness.",
                    Allowed::whole(1, 2));
    }

    void
    check_thickness(const MatrixParameters &matrix,
                    const Parameters       &parameters)
    {
      if (matrix.thickness <= matrix.overlap && parameters.has_matrix() &&
          matrix.layers != Layers::filled)
        throw InputError(parameters.where("Matrix/Thickness") + " = " +
                         exact_text(matrix.thickness) +
                         ": a layer is not thicker than the overlap, " +
                         exact_text(matrix.overlap) +
                         "; allowed: more than Matrix/Overlap");
    }

    void
    check_size(const MatrixParameters &matrix, const Parameters &parameters)
    {
      for (const auto &[entry, size] :
           {std::pair{"Matrix/Size along x", matrix.size_x},
            {"Matrix/Size along y", matrix.size_y}})
        if (parameters.fabric.periodic && size > 0)
          throw InputError(parameters.where(entry) +
                           ": a periodic cell has a matrix of its own size; "
                           "allowed: 0");
      const double degree = matrix.degree;
      if (parameters.has_matrix())
        check_number_of_nodes((matrix.layers == Layers::both ? 2 : 1) *
                                (degree * matrix.cells_along_x + 1) *
                                (degree * matrix.cells_along_y + 1) *
                                (degree * matrix.cells_through_thickness + 1),
                              parameters.where("Matrix/Cells along x") +
                                ", along y and through thickness");
    }
  } // namespace



  void
  CoatSettings::declare(ParameterCatalogue &catalogue)
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
    catalogue.add(
      "Junction stiffness",
      matrix.junction_stiffness,
      "Stiffness of the junctions per length of fiber [MPa]. 0: 2 pi G / "
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
  CoatSettings::resolve(const Parameters &parameters)
  {
    const auto replace_zero = [](auto &value, const auto automatic) {
      if (value == 0)
        value = automatic;
    };
    const FabricParameters &fabric = parameters.fabric;
    const FibersParameters &fibers = parameters.fibers;
    double                  radius =
      std::max(fabric.warp.fiber_radius, fabric.fill.fiber_radius);
    double       element = std::min(fabric.warp.element_length(fabric.fill),
                              fabric.fill.element_length(fabric.warp));
    unsigned int cells_along_x = 2 * fabric.fill.tows,
                 cells_along_y = 2 * fabric.warp.tows;
    if (!parameters.is_fabric())
      {
        radius  = *std::max_element(fibers.radius.begin(), fibers.radius.end());
        element = 4 * radius;
        cells_along_x = cells_along_y = 8;
      }
    replace_zero(matrix.overlap, radius);
    replace_zero(matrix.thickness, 6 * radius);
    replace_zero(matrix.junction_spacing, .5 * element);
    replace_zero(matrix.cells_along_x, cells_along_x);
    replace_zero(matrix.cells_along_y, cells_along_y);
  }



  void
  CoatSettings::check(const Parameters &parameters) const
  {
    check_thickness(matrix, parameters);
    check_size(matrix, parameters);
    if (parameters.has_stage(stage) && !parameters.has_matrix())
      throw InputError(parameters.where("Stages") +
                       ": coat has nothing to do, as Matrix/Layers is none; "
                       "allowed: upper, lower, both or filled there");
  }



  std::vector<std::string>
  CoatSettings::notes(const Parameters &parameters) const
  {
    static const UsualRange modulus{
      "a matrix", 1e-3, 1e6, "MPa", {{"GPa", 1e3}, {"Pa", 1e-6}}};
    if (!parameters.has_matrix() || is_usual(matrix.young_modulus, modulus))
      return {};
    return {parameters.where("Matrix/Young modulus") + ": " +
            explain_unusual(matrix.young_modulus, modulus)};
  }



  const MatrixParameters &
  matrix_of(const Parameters &parameters)
  {
    return parameters.stage_settings.get<CoatSettings>().matrix;
  }
} // namespace fiberloom
