// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/output/tow_regions.h>
#include <fiberloom/output/voxels.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace fiberloom
{
  namespace
  {
    constexpr double most_automatic = 1e6;

    // Pieces of fibers along an edge of a voxel.
    constexpr double pieces_per_edge = 4;

    Lattice
    voxel_centers(const std::array<Vector3, 2> &box, const double size)
    {
      Lattice       lattice{Vector3::Zero(), size, {}};
      const Vector3 middle = .5 * (box[0] + box[1]);
      for (unsigned int d = 0; d < 3; ++d)
        {
          lattice.n[d] =
            std::max(1.,
                     std::ceil((box[1][d] - box[0][d]) / size * (1 - 1e-12)));
          lattice.origin[d] = middle[d] - .5 * (lattice.n[d] - 1) * size;
        }
      return lattice;
    }

    /** Which tow has each center, and the direction of the tow there. */
    void
    assign_tows(const std::vector<TowShape> &shapes, VoxelGrid &grid)
    {
      const TowRegions regions(shapes, grid.centers, 0, grid.centers.spacing);
      for (std::size_t t = 0; t < shapes.size(); ++t)
        shapes[t].visit(grid.centers,
                        0,
                        [&](const Lattice::Index  &i,
                            const TowShape::Value &value) {
                          if (regions.level(t, i, value) >= 0)
                            return;
                          grid.tows[grid.centers.number(i)] = t;
                          grid.orientations[grid.centers.number(i)] =
                            value.direction;
                        });
    }

    /** Points of a disc of radius 1, each for the same share of its area. */
    std::vector<TowCut::Point>
    disc_points(const unsigned int n)
    {
      const double golden_angle = dealii::numbers::PI * (3 - std::sqrt(5.));
      std::vector<TowCut::Point> points;
      for (unsigned int k = 0; k < n; ++k)
        {
          const double distance = std::sqrt((k + .5) / n);
          points.push_back({{distance * std::cos(k * golden_angle),
                             distance * std::sin(k * golden_angle)}});
        }
      return points;
    }

    /** Adds fibers to voxels, piece by piece. */
    class Filler
    {
    public:
      Filler(const FiberMesh &mesh, const DofVector &q, VoxelGrid &grid)
        : mesh(mesh)
        , q(q)
        , grid(grid)
        , piece(grid.centers.spacing / pieces_per_edge)
        , directions(grid.centers.size(), Vector3::Zero())
      {
        for (unsigned int f = 0; f < mesh.lines().size(); ++f)
          add_fiber(f);
        for (std::size_t v = 0; v < directions.size(); ++v)
          if (directions[v].norm() > 0)
            grid.orientations[v] = directions[v].normalized();
      }

    private:
      const FiberMesh     &mesh;
      const DofVector     &q;
      VoxelGrid           &grid;
      const double         piece; // size of what is added at once [mm]
      std::vector<Vector3> directions;

      void
      add_fiber(const unsigned int fiber)
      {
        const auto  &line = mesh.lines()[fiber];
        const double area = dealii::numbers::PI * line.radius * line.radius;
        const auto   disc = disc_points(
          std::max(4u, static_cast<unsigned int>(area / (piece * piece))));
        const unsigned int n =
          line.n_elements *
          std::max(1., std::ceil(line.length / line.n_elements / piece));
        const double step = double(line.n_elements) / n;
        for (unsigned int i = 0; i < n; ++i)
          {
            const Section section =
              mesh.section(q, mesh.locate(fiber, (i + .5) * step));
            const double volume = dealii::numbers::PI * step *
                                  section.vector_1.cross(section.vector_2)
                                    .dot(section.center_derivative);
            grid.tow_volumes[line.tow] += volume;
            for (const TowCut::Point &point : disc)
              add(section.center + point[0] * section.vector_1 +
                    point[1] * section.vector_2,
                  section.tangent(),
                  volume / disc.size());
          }
      }

      /** Skins have rounded corners, boxes do not: nothing may be lost. */
      void
      add(const Vector3 &position, const Vector3 &tangent, const double volume)
      {
        Lattice::Index i = grid.centers.nearest(position);
        for (unsigned int d = 0; d < 3; ++d)
          i[d] = std::clamp(i[d], 0, grid.centers.n[d] - 1);
        const std::size_t v = grid.centers.number(i);
        grid.fractions[v] += volume / grid.cube();
        directions[v] += volume * tangent;
      }
    };
  } // namespace



  double
  voxel_size(const double                  wanted,
             const double                  radius,
             const std::array<Vector3, 2> &box)
  {
    return wanted > 0 ?
             wanted :
             std::max(radius,
                      std::cbrt((box[1] - box[0]).prod() / most_automatic));
  }



  VoxelGrid
  fill_voxels(const FiberMesh             &mesh,
              const DofVector             &q,
              const std::vector<TowShape> &shapes,
              const double                 size)
  {
    VoxelGrid grid;
    grid.centers = voxel_centers(enclosing_box(shapes), size);
    grid.tows.assign(grid.centers.size(), -1);
    grid.fractions.assign(grid.centers.size(), 0);
    grid.orientations.assign(grid.centers.size(), Vector3::Zero());
    grid.tow_volumes.assign(shapes.size(), 0);
    assign_tows(shapes, grid);
    Filler(mesh, q, grid);
    return grid;
  }
} // namespace fiberloom
