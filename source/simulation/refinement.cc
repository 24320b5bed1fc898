// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/simulation/refinement.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace fiberloom
{
  namespace
  {
    Vector3
    interpolate(const MatrixMesh      &mesh,
                const Eigen::VectorXd &x,
                const CellPoint       &point)
    {
      const auto  N        = mesh.shape_values(point);
      const auto &nodes    = mesh.nodes(point.cell);
      Vector3     position = Vector3::Zero();
      for (unsigned int a = 0; a < nodes.size(); ++a)
        position += N[a] * x.segment<3>(3 * nodes[a]);
      return position;
    }
  } // namespace



  Parameters
  refine(Parameters parameters, const Refinement &refinement)
  {
    for (TowParameters *tows :
         {&parameters.fabric.warp, &parameters.fabric.fill})
      tows->elements_per_fiber *= refinement.elements;
    parameters.fibers.elements_per_fiber *= refinement.elements;
    parameters.contact.stations_per_element *=
      refinement.stations / refinement.elements;
    parameters.contact.line_stiffness *= refinement.stiffness;
    parameters.contact.initial_stiffness *= refinement.stiffness;
    parameters.solver.contact_tolerance *= tighter;
    parameters.solver.newton_tolerance *= tighter;
    return parameters;
  }



  Transfer::Transfer(const Scene       &scene,
                     const MatrixState &matrix,
                     const FiberMesh   &fine,
                     const Refinement  &refinement)
    : coarse(scene.mesh)
    , composite(scene.composite)
    , fine(fine)
    , refinement(refinement)
    , finer_matrix(matrix)
  {
    for (Junction &junction : finer_matrix.junctions)
      junction.point =
        fine.locate(coarse.fiber_of_element(junction.point.element),
                    ratio(coarse.fiber_of_element(junction.point.element)) *
                      coarse.parameter(junction.point));
    if (composite)
      refine_cells();
  }



  State
  Transfer::operator()(State state) const
  {
    for (DofVector *q : {&state.q, &state.stage_start_q, &state.previous.q})
      if (q->size() > 0)
        {
          const DofVector       fibers = fiber_dofs(*q);
          const Eigen::VectorXd matrix = matrix_dofs(*q);
          q->resize(fibers.size() + matrix.size());
          *q << fibers, matrix;
        }
    state.matrix = finer_matrix;
    for (auto *zones : {&state.stage_start_zones, &state.contact.zones})
      for (ContactZone &zone : *zones)
        {
          for (unsigned int s = 0; s < 2; ++s)
            for (double &u : zone.range[s])
              u *= ratio(zone.fibers[s]);
          for (auto &[end, stiffness] : zone.stiffness)
            {
              end *= ratio(zone.fibers[0]);
              stiffness *= refinement.stiffness;
            }
          if (refinement.stations != 1)
            zone.divided.clear();
        }
    state.fibers = fiber_history(state.fibers);
    for (FrictionHistory &slip : state.contact.history)
      for (unsigned int s = 0; s < 2; ++s)
        slip.u[s] *= ratio(slip.fibers[s]);
    for (PlateHistory &slip : state.contact.plates)
      slip.u *= ratio(slip.fiber);
    return state;
  }



  double
  Transfer::ratio(const unsigned int fiber) const
  {
    return double(fine.with_images().lines()[fiber].n_elements) /
           coarse.with_images().lines()[fiber].n_elements;
  }



  DofVector
  Transfer::fiber_dofs(const DofVector &q) const
  {
    const auto      n            = coarse.reference().size();
    const DofVector displacement = q.head(n) - coarse.reference();
    DofVector       result       = fine.reference();
    for (unsigned int f = 0; f < fine.lines().size(); ++f)
      for (unsigned int k = 0; k < fine.lines()[f].n_nodes(); ++k)
        {
          const ElementPoint point = coarse.locate(f, .5 * k / ratio(f));
          const auto         N     = shape_values(point.xi);
          for (unsigned int a = 0; a < 3; ++a)
            result.segment<9>(9 * (fine.lines()[f].first_node + k)) +=
              N[a] * displacement.segment<9>(
                       9 * (coarse.first_node(point.element) + a));
        }
    return result;
  }



  FiberHistory
  Transfer::fiber_history(const FiberHistory &history) const
  {
    FiberHistory result;
    for (const auto &[element, entry] : history.breaks)
      {
        const unsigned int f = coarse.fiber_of_element(element),
                           n = std::lround(ratio(f));
        for (unsigned int part = 0; part < n; ++part)
          result
            .breaks[fine.lines()[f].first_element +
                    n * (element - coarse.lines()[f].first_element) + part] =
            entry;
      }
    return result;
  }



  Eigen::VectorXd
  Transfer::matrix_dofs(const DofVector &q) const
  {
    if (!composite)
      return {};
    const MatrixMesh     &matrix = composite->matrix();
    const Eigen::VectorXd x      = composite->positions(q);
    Eigen::VectorXd       result(3 * places.size());
    for (unsigned int n = 0; n < places.size(); ++n)
      result.segment<3>(3 * n) = interpolate(matrix, x, places[n]);
    return result;
  }



  void
  Transfer::refine_cells()
  {
    const MatrixMesh  &matrix = composite->matrix();
    const unsigned int n      = refinement.cells;
    // Numbers of the cells in place of a coarse one, x first.
    std::vector<std::vector<unsigned int>> parts(
      matrix.n_cells(), std::vector<unsigned int>(n * n * n));
    unsigned int first_coarse = 0, fine_cell = 0;
    for (LayerBlock &block : finer_matrix.layers.blocks)
      {
        const auto coarse = block.n_cells;
        block             = subdivided(block, n);
        for (unsigned int k = 0; k < block.n_cells[2]; ++k)
          for (unsigned int j = 0; j < block.n_cells[1]; ++j)
            for (unsigned int i = 0; i < block.n_cells[0]; ++i)
              {
                const unsigned int cell =
                  first_coarse + i / n +
                  coarse[0] * (j / n + coarse[1] * (k / n));
                parts[cell][i % n + n * (j % n + n * (k % n))] = fine_cell++;
              }
        first_coarse += coarse[0] * coarse[1] * coarse[2];
      }

    for (Junction &junction : finer_matrix.junctions)
      {
        const Vector3               place = n * junction.place.coordinates;
        std::array<unsigned int, 3> corner;
        for (unsigned int d = 0; d < 3; ++d)
          corner[d] = std::clamp(int(place[d]), 0, int(n) - 1);
        junction.place = {parts[junction.place.cell]
                               [corner[0] + n * (corner[1] + n * corner[2])],
                          place - Vector3(corner[0], corner[1], corner[2])};
      }

    finer_composite         = std::make_unique<Composite>(finer_matrix, fine);
    const MatrixMesh &finer = finer_composite->matrix();
    places.resize(finer.n_nodes());
    for (unsigned int cell = 0; cell < matrix.n_cells(); ++cell)
      for (unsigned int part = 0; part < parts[cell].size(); ++part)
        {
          const Vector3 corner(part % n, part / n % n, part / n / n);
          const auto   &nodes = finer.nodes(parts[cell][part]);
          for (unsigned int a = 0; a < nodes.size(); ++a)
            places[nodes[a]] = {cell, (corner + finer.unit_point(a)) / n};
        }
  }
} // namespace fiberloom
