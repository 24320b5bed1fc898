// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/parameter_catalogue.h>

#include <fiberloom/matrix/layer_geometry.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>

namespace fiberloom
{
  namespace
  {
    // Of a corner, see worst_corner(); a corner of 15 degrees has .26.
    constexpr double       least_corner       = .2;
    constexpr unsigned int largest_smoothings = 200;

    std::vector<double>
    grid_lines(const double low, const double high, const unsigned int n_cells)
    {
      std::vector<double> lines;
      for (unsigned int i = 0; i <= n_cells; ++i)
        lines.push_back(low + (high - low) * i / n_cells);
      return lines;
    }

    /** Cells between heights over a grid, one for each vertex, x first. */
    LayerBlock
    make_block(const std::vector<double> &x,
               const std::vector<double> &y,
               const std::vector<double> &bottom,
               const std::vector<double> &top,
               const unsigned int         n_through)
    {
      LayerBlock block;
      block.n_cells = {{static_cast<unsigned int>(x.size() - 1),
                        static_cast<unsigned int>(y.size() - 1),
                        n_through}};
      for (unsigned int k = 0; k <= n_through; ++k)
        for (unsigned int j = 0; j < y.size(); ++j)
          for (unsigned int i = 0; i < x.size(); ++i)
            {
              const unsigned int v = i + x.size() * j;
              const double       t = double(k) / n_through;
              block.vertices.insert(block.vertices.end(),
                                    {x[i],
                                     y[j],
                                     bottom[v] + t * (top[v] - bottom[v])});
            }
      return block;
    }

    void
    repair_or_refuse(LayerBlock        &block,
                     const unsigned int k_face,
                     const Borders      borders)
    {
      if (!repair(block, k_face, borders))
        throw InputError(
          "Matrix: the woven surface is too rough for the cells, whose worst "
          "corner stays at " +
          exact_text(worst_corner(block)) + " of a right one's volume; " +
          "allowed: fewer Cells along x and y, or a larger Thickness");
    }

    // Of the fabric's thickness, what each of two layers overlaps at most: next
    // to a single fiber they would meet.
    constexpr double largest_part = .45;

    /** Lets faces on the woven surface into the fabric. */
    void
    overlap_fabric(std::vector<double> &lower,
                   std::vector<double> &upper,
                   const double         overlap,
                   const Layers         layers)
    {
      unsigned int n_thin = 0;
      for (unsigned int v = 0; v < upper.size(); ++v)
        {
          double depth = overlap;
          if (layers == Layers::both)
            depth = std::min(depth, largest_part * (upper[v] - lower[v]));
          n_thin += depth < overlap;
          lower[v] += depth;
          upper[v] -= depth;
        }
      if (n_thin > .5 * upper.size())
        throw InputError("Matrix: the two layers meet inside most of the "
                         "fabric; allowed: a smaller Overlap, or filled as "
                         "Layers");
    }
  } // namespace



  Extent
  skin_extent(const FiberMesh &mesh, const DofVector &q)
  {
    Extent extent{Vector3::Constant(std::numeric_limits<double>::max()),
                  Vector3::Constant(-std::numeric_limits<double>::max())};
    for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
      {
        const Vector3 center = q.segment<3>(9 * n);
        const Vector3 reach  = (q.segment<3>(9 * n + 3).cwiseAbs2() +
                               q.segment<3>(9 * n + 6).cwiseAbs2())
                                .cwiseSqrt();
        extent.low  = extent.low.cwiseMin(center - reach);
        extent.high = extent.high.cwiseMax(center + reach);
      }
    return extent;
  }



  unsigned int
  n_layer_nodes(const MatrixParameters &parameters)
  {
    const unsigned int n_layers = parameters.layers == Layers::none ? 0 :
                                  parameters.layers == Layers::both ? 2 :
                                                                      1;
    return n_layers * (parameters.degree * parameters.cells_along_x + 1) *
           (parameters.degree * parameters.cells_along_y + 1) *
           (parameters.degree * parameters.cells_through_thickness + 1);
  }



  Extent
  fabric_extent(const FiberMesh &mesh, const DofVector &q)
  {
    Extent        extent = skin_extent(mesh, q);
    const Vector3 middle = .5 * (extent.low + extent.high);
    for (unsigned int n = 0; n < mesh.originals().size(); ++n)
      if (const NodeImage &image = mesh.originals()[n]; image.node != n)
        {
          const unsigned int axis = image.periods[0] == 1 ? 0 : 1;
          const Vector3      period =
            q.segment<3>(9 * n) - q.segment<3>(9 * image.node);
          if (std::abs(period[1 - axis]) > 1e-6 * period[axis])
            throw InputError("Stages: coat needs a cell whose periods are at "
                             "right angles; allowed: coat before shear");
          extent.low[axis]  = middle[axis] - .5 * period[axis];
          extent.high[axis] = middle[axis] + .5 * period[axis];
        }
    return extent;
  }



  LayerGeometry
  build_layers(const MatrixParameters &parameters,
               const FiberMesh        &mesh,
               const DofVector        &q)
  {
    Extent       extent = fabric_extent(mesh, q);
    const Layers layers = parameters.layers;
    for (const unsigned int c : {0, 1})
      if (const double size = c == 0 ? parameters.size_x : parameters.size_y;
          size > 0)
        {
          const double middle = .5 * (extent.low[c] + extent.high[c]);
          extent.low[c]       = middle - .5 * size;
          extent.high[c]      = middle + .5 * size;
        }
    const auto x =
      grid_lines(extent.low.x(), extent.high.x(), parameters.cells_along_x);
    const auto y =
      grid_lines(extent.low.y(), extent.high.y(), parameters.cells_along_y);
    const unsigned int        n = parameters.cells_through_thickness;
    const std::vector<double> bottom(x.size() * y.size(),
                                     extent.low.z() - parameters.thickness),
      top(x.size() * y.size(), extent.high.z() + parameters.thickness);

    const Borders borders = borders_of(mesh);
    LayerGeometry geometry;
    if (layers == Layers::filled)
      {
        geometry.blocks.push_back(make_block(x, y, bottom, top, n));
        return geometry;
      }

    std::vector<double> lower = surface_heights(mesh, q, Side::lower, x, y),
                        upper = surface_heights(mesh, q, Side::upper, x, y);
    overlap_fabric(lower, upper, parameters.overlap, layers);
    if (layers == Layers::lower || layers == Layers::both)
      {
        geometry.blocks.push_back(make_block(x, y, bottom, lower, n));
        repair_or_refuse(geometry.blocks.back(), n, borders);
      }
    if (layers == Layers::upper || layers == Layers::both)
      {
        geometry.blocks.push_back(make_block(x, y, upper, top, n));
        repair_or_refuse(geometry.blocks.back(), 0, borders);
      }
    return geometry;
  }



  LayerBlock
  subdivided(const LayerBlock &block, const unsigned int n)
  {
    LayerBlock fine;
    for (unsigned int d = 0; d < 3; ++d)
      fine.n_cells[d] = n * block.n_cells[d];
    for (unsigned int k = 0; k <= fine.n_cells[2]; ++k)
      for (unsigned int j = 0; j <= fine.n_cells[1]; ++j)
        for (unsigned int i = 0; i <= fine.n_cells[0]; ++i)
          {
            const std::array<unsigned int, 3> place{{i, j, k}};
            Vector3                           vertex = Vector3::Zero();
            for (unsigned int corner = 0; corner < 8; ++corner)
              {
                double                      weight = 1;
                std::array<unsigned int, 3> coarse;
                for (unsigned int d = 0; d < 3; ++d)
                  {
                    const bool   far  = corner >> d & 1;
                    const double part = place[d] % n / double(n);
                    coarse[d]         = place[d] / n + far;
                    weight *= far ? part : 1 - part;
                  }
                if (weight > 0) // others may lie outside
                  vertex +=
                    weight * block.vertex(coarse[0], coarse[1], coarse[2]);
              }
            fine.vertices.insert(fine.vertices.end(),
                                 vertex.data(),
                                 vertex.data() + 3);
          }
    return fine;
  }



  double
  worst_corner(const LayerBlock &block)
  {
    const auto &n     = block.n_cells;
    double      worst = 1;
    for (unsigned int k = 0; k < n[2]; ++k)
      for (unsigned int j = 0; j < n[1]; ++j)
        for (unsigned int i = 0; i < n[0]; ++i)
          for (unsigned int corner = 0; corner < 8; ++corner)
            {
              const unsigned int a = corner % 2, b = corner / 2 % 2,
                                 c = corner / 4;
              const auto edge = [&](const Vector3 &from, const Vector3 &to) {
                return Vector3(to - from).normalized();
              };
              const Vector3 along_x = edge(block.vertex(i, j + b, k + c),
                                           block.vertex(i + 1, j + b, k + c)),
                            along_y = edge(block.vertex(i + a, j, k + c),
                                           block.vertex(i + a, j + 1, k + c)),
                            along_z = edge(block.vertex(i + a, j + b, k),
                                           block.vertex(i + a, j + b, k + 1));
              worst = std::min(worst, along_x.cross(along_y).dot(along_z));
            }
    return worst;
  }



  bool
  repair(LayerBlock &block, const unsigned int k_face, const Borders borders)
  {
    // What is next to a border of a cell is next to the opposite one.
    const auto neighbor = [&](const int i, const int n) {
      return borders == Borders::periodic ? (i + n) % n : i;
    };
    const unsigned int n_x = block.n_cells[0], n_y = block.n_cells[1],
                       n_z      = block.n_cells[2];
    const unsigned int opposite = k_face == 0 ? n_z : 0;
    for (unsigned int pass = 0; pass < largest_smoothings; ++pass)
      {
        if (worst_corner(block) >= least_corner)
          return true;
        const LayerBlock before = block;
        for (unsigned int j = 0; j <= n_y; ++j)
          for (unsigned int i = 0; i <= n_x; ++i)
            {
              double       sum = 0;
              unsigned int n   = 0;
              for (const auto &[di, dj] :
                   {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}})
                {
                  const int a = neighbor(int(i) + di, n_x),
                            b = neighbor(int(j) + dj, n_y);
                  if (a < 0 || a > int(n_x) || b < 0 || b > int(n_y))
                    continue;
                  sum += before.vertex(a, b, k_face).z();
                  ++n;
                }
              const double face =
                .5 * (before.vertex(i, j, k_face).z() + sum / n);
              const double other = block.vertex(i, j, opposite).z();
              for (unsigned int k = 0; k <= n_z; ++k)
                {
                  const double t = std::abs(double(k) - opposite) / n_z;
                  block.vertices[3 * block.index(i, j, k) + 2] =
                    other + t * (face - other);
                }
            }
      }
    return worst_corner(block) >= least_corner;
  }
} // namespace fiberloom
