// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/matrix/matrix_mesh.h>

#include <deal.II/base/point.h>
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_tools_cache.h>
#include <deal.II/grid/tria.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>

namespace fiberloom
{
  struct MatrixMesh::Mesh
  {
    explicit Mesh(const unsigned int degree)
      : fe(degree)
      , dof_handler(triangulation)
      , search(triangulation, mapping)
    {}

    const dealii::FE_Q<3>       fe;
    const dealii::MappingQ1<3>  mapping;
    dealii::Triangulation<3>    triangulation;
    dealii::DoFHandler<3>       dof_handler; // one dof a node
    dealii::GridTools::Cache<3> search;
  };



  MatrixMesh::MatrixMesh(const LayerGeometry   &geometry,
                         const unsigned int     degree,
                         const HyperelasticLaw &law)
    : material(law)
    , mesh(std::make_unique<Mesh>(degree))
  {
    create_cells(geometry);
    mesh->dof_handler.distribute_dofs(mesh->fe);

    std::vector<dealii::Point<3>> points(mesh->dof_handler.n_dofs());
    dealii::DoFTools::map_dofs_to_support_points(mesh->mapping,
                                                 mesh->dof_handler,
                                                 points);
    stress_free.resize(3 * points.size());
    for (unsigned int n = 0; n < points.size(); ++n)
      for (unsigned int c = 0; c < 3; ++c)
        stress_free[3 * n + c] = points[n][c];

    set_up_elements();
    for (const unsigned int axis : {0, 1})
      {
        const unsigned int start = border_nodes(border_across(axis, 0))[0];
        period_nodes[axis]       = {
                {nearest_across(start, axis, border_nodes(border_across(axis, 1))),
                 start}};
      }
  }



  MatrixMesh::~MatrixMesh() = default;



  unsigned int
  MatrixMesh::degree() const
  {
    return mesh->fe.degree;
  }



  void
  MatrixMesh::create_cells(const LayerGeometry &geometry)
  {
    std::vector<dealii::Point<3>>    vertices;
    std::vector<dealii::CellData<3>> cells;
    for (const LayerBlock &block : geometry.blocks)
      {
        const unsigned int first = vertices.size();
        for (std::size_t i = 0; i < block.vertices.size(); i += 3)
          vertices.emplace_back(block.vertices[i],
                                block.vertices[i + 1],
                                block.vertices[i + 2]);
        const auto &n = block.n_cells;
        for (unsigned int k = 0; k < n[2]; ++k)
          for (unsigned int j = 0; j < n[1]; ++j)
            for (unsigned int i = 0; i < n[0]; ++i)
              {
                dealii::CellData<3> cell;
                for (unsigned int v = 0; v < 8; ++v)
                  cell.vertices[v] =
                    first + block.index(i + v % 2, j + v / 2 % 2, k + v / 4);
                cells.push_back(cell);
              }
        // Outer faces are flat: a face of one height is a border.
        for (const unsigned int side : {0, 1})
          {
            const unsigned int k    = side == 0 ? 0 : n[2];
            bool               flat = true;
            for (unsigned int j = 0; j <= n[1]; ++j)
              for (unsigned int i = 0; i <= n[0]; ++i)
                flat = flat &&
                       block.vertex(i, j, k).z() == block.vertex(0, 0, k).z();
            has_flat_face[side] = has_flat_face[side] || flat;
          }
      }
    mesh->triangulation.create_triangulation(vertices, cells, {});
  }



  void
  MatrixMesh::set_up_elements()
  {
    const dealii::FE_Q<3>      &fe      = mesh->fe;
    const dealii::MappingQ1<3> &mapping = mesh->mapping;
    const dealii::QGauss<3>     rule(fe.degree + 1);
    const dealii::Quadrature<3> nodes(fe.get_unit_support_points());
    dealii::FEValues<3>         at_points(
      mapping, fe, rule, dealii::update_gradients | dealii::update_JxW_values);
    dealii::FEValues<3> at_nodes(mapping, fe, nodes, dealii::update_gradients);
    const auto          gradients = [&fe](const dealii::FEValues<3> &values,
                                 const unsigned int         n_points) {
      std::vector<HexElement::Gradients> result(
        n_points, HexElement::Gradients(fe.n_dofs_per_cell(), 3));
      for (unsigned int p = 0; p < n_points; ++p)
        for (unsigned int a = 0; a < fe.n_dofs_per_cell(); ++a)
          for (unsigned int c = 0; c < 3; ++c)
            result[p](a, c) = values.shape_grad(a, p)[c];
      return result;
    };

    std::vector<dealii::types::global_dof_index> dofs(fe.n_dofs_per_cell());
    for (const auto &cell : mesh->dof_handler.active_cell_iterators())
      {
        at_points.reinit(cell);
        at_nodes.reinit(cell);
        cell->get_dof_indices(dofs);
        cell_nodes.emplace_back(dofs.begin(), dofs.end());
        const std::vector<double> volumes = at_points.get_JxW_values();
        const auto                slopes  = gradients(at_points, rule.size());
        double                    sum     = 0;
        for (unsigned int p = 0; p < rule.size(); ++p)
          {
            volume += volumes[p];
            sum += volumes[p] * slopes[p].squaredNorm();
          }
        slope = std::max(slope, sum);
        elements.emplace_back(slopes, volumes, material);
        node_gradients.push_back(gradients(at_nodes, nodes.size()));
      }
  }



  double
  MatrixMesh::cell_size() const
  {
    return std::cbrt(volume / n_cells());
  }



  std::vector<unsigned int>
  MatrixMesh::border_nodes(const MatrixBorder border) const
  {
    const unsigned int axis = static_cast<unsigned int>(border) / 2,
                       side = static_cast<unsigned int>(border) % 2;
    if (axis == 2 && !has_flat_face[side])
      return {};
    const auto position = [&](const unsigned int node) {
      return (side == 0 ? 1 : -1) * stress_free[3 * node + axis];
    };
    double outermost = position(0);
    for (unsigned int n = 0; n < n_nodes(); ++n)
      outermost = std::min(outermost, position(n));
    std::vector<unsigned int> nodes;
    for (unsigned int n = 0; n < n_nodes(); ++n)
      if (position(n) < outermost + 1e-6 * cell_size())
        nodes.push_back(n);
    return nodes;
  }



  unsigned int
  MatrixMesh::nearest_across(const unsigned int               node,
                             const unsigned int               axis,
                             const std::vector<unsigned int> &nodes) const
  {
    const auto distance = [&](const unsigned int other) {
      Vector3 away =
        stress_free.segment<3>(3 * other) - stress_free.segment<3>(3 * node);
      away[axis] = 0;
      return away.squaredNorm();
    };
    return *std::min_element(nodes.begin(),
                             nodes.end(),
                             [&](const unsigned int a, const unsigned int b) {
                               return distance(a) < distance(b);
                             });
  }



  std::vector<NodeImage>
  MatrixMesh::originals() const
  {
    std::vector<NodeImage> images;
    for (unsigned int n = 0; n < n_nodes(); ++n)
      images.push_back({n, {{0, 0}}});
    for (const unsigned int axis : {0, 1})
      {
        const std::vector<unsigned int> starts =
          border_nodes(border_across(axis, 0));
        for (const unsigned int node : border_nodes(border_across(axis, 1)))
          {
            // Along y, what is at the end of x is an image already.
            images[node] = images[nearest_across(node, axis, starts)];
            images[node].periods[axis] = 1;
          }
      }
    return images;
  }



  std::array<int, 2>
  MatrixMesh::move_to_cell(Vector3 &position) const
  {
    std::array<int, 2> periods;
    for (const unsigned int axis : {0, 1})
      {
        const auto [image, original] = period_nodes[axis];
        const double start           = stress_free[3 * original + axis],
                     size            = stress_free[3 * image + axis] - start;
        periods[axis] = std::floor((position[axis] - start) / size);
        position[axis] -= periods[axis] * size;
      }
    return periods;
  }



  std::optional<CellPoint>
  MatrixMesh::locate(const Vector3 &position) const
  {
    // Of cells that share a face the first one, whatever the tree's order is.
    const dealii::Point<3>   place(position.x(), position.y(), position.z());
    std::optional<CellPoint> found;
    for (const auto &[box, cell] :
         mesh->search.get_cell_bounding_boxes_rtree() |
           boost::geometry::index::adaptors::queried(
             boost::geometry::index::intersects(place)))
      if (!found || cell->active_cell_index() < found->cell)
        try
          {
            const auto point =
              mesh->mapping.transform_real_to_unit_cell(cell, place);
            if (dealii::GeometryInfo<3>::is_inside_unit_cell(point, 1e-10))
              found = CellPoint{cell->active_cell_index(),
                                Vector3(point[0], point[1], point[2])};
          }
        catch (const dealii::Mapping<3>::ExcTransformationFailed &)
          {} // far from this cell
    return found;
  }



  Vector3
  MatrixMesh::unit_point(const unsigned int node_of_cell) const
  {
    const auto &point = mesh->fe.get_unit_support_points()[node_of_cell];
    return {point[0], point[1], point[2]};
  }



  std::vector<double>
  MatrixMesh::shape_values(const CellPoint &point) const
  {
    const Vector3      &xi = point.coordinates;
    std::vector<double> values(mesh->fe.n_dofs_per_cell());
    for (unsigned int a = 0; a < values.size(); ++a)
      values[a] =
        mesh->fe.shape_value(a, dealii::Point<3>(xi.x(), xi.y(), xi.z()));
    return values;
  }



  Matrix3
  MatrixMesh::deformation_gradient(const Eigen::VectorXd &x,
                                   const unsigned int     cell,
                                   const unsigned int     node_of_cell) const
  {
    Matrix3 F = Matrix3::Zero();
    for (unsigned int a = 0; a < cell_nodes[cell].size(); ++a)
      F += x.segment<3>(3 * cell_nodes[cell][a]) *
           node_gradients[cell][node_of_cell].row(a);
    return F;
  }



  Eigen::VectorXd
  MatrixMesh::cell_positions(const Eigen::VectorXd &x,
                             const unsigned int     cell) const
  {
    const auto     &nodes = cell_nodes[cell];
    Eigen::VectorXd positions(3 * nodes.size());
    for (unsigned int a = 0; a < nodes.size(); ++a)
      positions.segment<3>(3 * a) = x.segment<3>(3 * nodes[a]);
    return positions;
  }
} // namespace fiberloom
