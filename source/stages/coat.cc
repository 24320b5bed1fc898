// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/parameter_catalogue.h>
#include <fiberloom/base/parameters.h>

#include <fiberloom/stages/coat.h>

#include <boost/format.hpp>

#include <algorithm>

namespace fiberloom
{
  namespace
  {
    // Of the particles on the woven surface; fewer make no composite.
    constexpr double least_part_inside = .15;
  } // namespace



  StageType
  Coat::type()
  {
    StageType type{CoatSettings::stage,
                   "adds layers of matrix",
                   StageType::Sample::fibers,
                   &make<Coat>,
                   &make_settings<CoatSettings>};
    type.adds_matrix = true;
    return type;
  }



  Supports
  Coat::supports(const DofVector &start) const
  {
    if (scene.fibers.pattern)
      return Relax::supports(start);
    // Loose fibers stay where they are until drives hold them.
    Supports supports;
    supports.bodies.push_back({"ground"});
    for (const auto &line : scene.mesh.lines())
      for (unsigned int n = 0; n < line.n_nodes(); ++n)
        {
          Attachment attachment;
          attachment.node = line.first_node + n;
          attachment.body = 0;
          attachment.held.set();
          supports.attachments.push_back(attachment);
        }
    return supports;
  }



  void
  Coat::begin(State &state) const
  {
    if (scene.fibers.pattern)
      Relax::begin(state);
    else
      state.placements.assign(1, Placement());
  }



  CurveRow
  Coat::curve(const State &state, const std::vector<BodyVector> &) const
  {
    double largest = 0;
    for (unsigned int j = 0; j < scene.composite->junctions().size(); ++j)
      largest =
        std::max(largest, scene.composite->junction_force(j, state.q).norm());
    return {{{"junctions", Quantity::number},
             double(scene.composite->junctions().size())},
            {{"largest_junction_force", Quantity::force}, largest}};
  }



  std::string
  add_matrix(const Parameters &parameters, const FiberMesh &mesh, State &state)
  {
    const MatrixParameters &wanted = matrix_of(parameters);
    MatrixState             matrix;
    matrix.layers        = build_layers(wanted, mesh, state.q);
    matrix.degree        = wanted.degree;
    matrix.law           = wanted.law;
    matrix.young_modulus = wanted.young_modulus;
    matrix.poisson_ratio = wanted.poisson_ratio;

    const MatrixMesh hexes(matrix.layers,
                           matrix.degree,
                           HyperelasticLaw(wanted.law,
                                           matrix.young_modulus,
                                           matrix.poisson_ratio));
    FoundJunctions   found = find_junctions(wanted, mesh, hexes, state.q);
    const auto       n     = found.junctions.size();
    if (n < least_part_inside * (n + found.n_outside))
      throw InputError(
        parameters.where("Matrix/Cells along x") +
        ": the mesh is too coarse to hold the fibers, of " +
        std::to_string(n + found.n_outside) +
        " particles on the surface only " + std::to_string(n) +
        " lie in a cell; allowed: more cells along x and y, or a larger "
        "Overlap");
    if (n == 0)
      throw InputError(parameters.where("Matrix/Layers") +
                       ": no fiber is in reach of the layers; allowed: layers "
                       "where fibers are, or a larger Overlap");
    matrix.junctions = std::move(found.junctions);

    const Eigen::VectorXd &nodes = hexes.reference();
    state.q.conservativeResize(9 * mesh.n_nodes() + nodes.size());
    state.q.tail(nodes.size()) = nodes;
    state.previous.q.resize(0);
    state.matrix = std::move(matrix);

    std::string note = "coat: " + std::to_string(hexes.n_cells()) + " cells, " +
                       std::to_string(nodes.size()) + " dofs, " +
                       std::to_string(n) + " junctions; ";
    if (found.n_outside == 0)
      return note + "no particle of the surface lies outside the cells";
    const Vector3 &place = found.an_outside_place;
    return note + std::to_string(found.n_outside) +
           " particles of the surface lie outside every cell and have none, "
           "one of them at " +
           exact_text(std::vector<double>{place.x(), place.y(), place.z()});
  }



  void
  check_junctions(const Parameters &parameters, const FiberMesh &mesh)
  {
    double n = 0;
    for (const auto &line : mesh.lines())
      n += line.length / matrix_of(parameters).junction_spacing;
    if (parameters.has_matrix() && n > Parameters::most_nodes)
      throw InputError(
        parameters.where("Matrix/Junction spacing") + ": up to " +
        (boost::format("%.3g") % n).str() + " junctions; allowed: at most " +
        std::to_string(Parameters::most_nodes) + ", by a larger spacing");
  }



  void
  check_matrix(const Parameters &parameters, const MatrixState &matrix)
  {
    if (matrix.is_empty())
      return;
    const MatrixParameters &wanted = matrix_of(parameters);
    const auto              demand = [&](const std::string &entry,
                            const bool         equal,
                            const std::string &its_value) {
      if (!equal)
        throw InputError(parameters.where("Matrix/" + entry) +
                         ": the layers of the restart file have " + its_value +
                         "; allowed: the same");
    };
    demand("Degree",
           wanted.degree == matrix.degree,
           std::to_string(matrix.degree));
    demand("Law", wanted.law == matrix.law, name_of(matrix.law));
    demand("Young modulus",
           wanted.young_modulus == matrix.young_modulus,
           exact_text(matrix.young_modulus));
    demand("Poisson ratio",
           wanted.poisson_ratio == matrix.poisson_ratio,
           exact_text(matrix.poisson_ratio));
  }
} // namespace fiberloom
