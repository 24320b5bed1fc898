// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// Layers of matrix on wavy fibers: outer faces flat at their thickness, inner
// ones under the woven surface by the overlap, borders, bad cells that are
// repaired, points found where they are, and layers that cannot be.

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/parameters.h>

#include <fiberloom/matrix/matrix_mesh.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "checks.h"
#include "sample_fibers.h"

using namespace fiberloom;

namespace
{
  /** Five waves side by side, of radius 1 and height 2. */
  FiberSet
  waves()
  {
    std::vector<Fiber> fibers;
    for (int f = -2; f <= 2; ++f)
      fibers.push_back(curved_fiber(
        [f](const double t) {
          return Vector3(60 * t - 30, 2.2 * f, std::cos(4 * M_PI * t));
        },
        16,
        Vector3::UnitZ()));
    return loose_fibers(fibers);
  }

  MatrixParameters
  parameters(const Layers layers)
  {
    MatrixParameters matrix;
    matrix.layers                  = layers;
    matrix.thickness               = 4;
    matrix.overlap                 = .5;
    matrix.cells_along_x           = 12;
    matrix.cells_along_y           = 2;
    matrix.cells_through_thickness = 2;
    return matrix;
  }

  const HyperelasticLaw law(MatrixLaw::neo_hooke, 1., .3);

  void
  check_faces(Checks &checks, const FiberMesh &fibers)
  {
    const LayerGeometry layers =
      build_layers(parameters(Layers::both), fibers, fibers.reference());
    checks.equal("layers", layers.blocks.size(), 2);
    const LayerBlock &lower = layers.blocks[0], &upper = layers.blocks[1];
    double            flat = 0, mirrored = 0, high = -10, low = 10;
    for (unsigned int j = 0; j <= 2; ++j)
      for (unsigned int i = 0; i <= 12; ++i)
        {
          flat = std::max(flat, std::abs(upper.vertex(i, j, 2).z() - 6));
          flat = std::max(flat, std::abs(lower.vertex(i, j, 0).z() + 6));
          const double inner = upper.vertex(i, j, 0).z();
          high               = std::max(high, inner);
          low                = std::min(low, inner);
          // Half a wave on, the lower side is what the upper one was.
          mirrored =
            std::max(mirrored,
                     std::abs(inner + lower.vertex((i + 3) % 12, j, 2).z()));
        }
    checks.below("outer faces off their thickness", flat, 1e-12);
    checks.equal("highest vertex inside, a crest less the overlap", high, 1.5);
    // Within half a cell of the trough: cos(5 pi/6) of the wave at its border.
    checks.below("lowest vertex inside",
                 low - (1 - .5 + std::cos(5. / 6 * M_PI)),
                 6e-2);
    checks.below("lower side mirrored", mirrored, 2e-2);

    const MatrixMesh mesh(layers, 2, law);
    checks.equal("nodes",
                 mesh.n_nodes(),
                 n_layer_nodes(parameters(Layers::both)));
    checks.equal("cells", mesh.n_cells(), 96);
    checks.equal("nodes on x start",
                 mesh.border_nodes(MatrixBorder::x_start).size(),
                 50);
    checks.equal("nodes on top",
                 mesh.border_nodes(MatrixBorder::top).size(),
                 125);
    const MatrixMesh upper_mesh(build_layers(parameters(Layers::upper),
                                             fibers,
                                             fibers.reference()),
                                1,
                                law);
    checks.equal("nodes on the bottom of an upper layer",
                 upper_mesh.border_nodes(MatrixBorder::bottom).size(),
                 0);
  }

  /** Two double rows of fibers and a single one beside them: there two layers
   * with an overlap of a radius would meet. */
  void
  check_thin_places(Checks &checks)
  {
    std::vector<Fiber> fibers;
    for (const Vector3 &place : {Vector3(0, 0, -1.05),
                                 Vector3(0, 0, 1.05),
                                 Vector3(0, 2.2, -1.05),
                                 Vector3(0, 2.2, 1.05),
                                 Vector3(0, 6, 0)})
      fibers.push_back(straight_fiber(place - Vector3(30, 0, 0),
                                      place + Vector3(30, 0, 0),
                                      4));
    const FiberSet   set = loose_fibers(fibers);
    const FiberMesh  mesh(set);
    MatrixParameters matrix = parameters(Layers::both);
    matrix.overlap          = 1;
    matrix.cells_along_y    = 4;
    const auto   layers     = build_layers(matrix, mesh, mesh.reference());
    const double thick      = layers.blocks[1].vertex(3, 1, 0).z(),
                 thin       = layers.blocks[1].vertex(3, 4, 0).z();
    checks.equal("inner face on two fibers, less the overlap", thick, 1.05);
    checks.equal("inner face on one, less 0.45 of its thickness", thin, .1);
    checks.equal("and from below", layers.blocks[0].vertex(3, 4, 2).z(), -.1);
  }

  void
  check_location(Checks &checks, const FiberMesh &fibers)
  {
    const MatrixMesh mesh(build_layers(parameters(Layers::both),
                                       fibers,
                                       fibers.reference()),
                          2,
                          law);
    double           error   = 0;
    unsigned int     n_found = 0;
    for (int i = -9; i <= 9; ++i)
      {
        const Vector3 point(3.1 * i, .4 * i, 3 + .1 * i);
        const auto    place = mesh.locate(point);
        if (!place)
          continue;
        ++n_found;
        const auto values = mesh.shape_values(*place);
        Vector3    found  = Vector3::Zero();
        for (unsigned int a = 0; a < values.size(); ++a)
          found += values[a] *
                   mesh.reference().segment<3>(3 * mesh.nodes(place->cell)[a]);
        error = std::max(error, (found - point).norm());
      }
    checks.equal("points found", n_found, 19);
    checks.below("their distance from where they are", error, 1e-12);
    checks.that("no cell between the layers", !mesh.locate(Vector3(0, .1, .9)));
    checks.that("no cell above", !mesh.locate(Vector3(0, 0, 6.01)));
  }

  void
  check_subdivision(Checks &checks, const FiberMesh &fibers)
  {
    const LayerBlock block =
      build_layers(parameters(Layers::upper), fibers, fibers.reference())
        .blocks[0];
    const LayerBlock fine = subdivided(block, 3);
    checks.equal("cells in place of one",
                 double(fine.n_cells[0] * fine.n_cells[1] * fine.n_cells[2]) /
                   (block.n_cells[0] * block.n_cells[1] * block.n_cells[2]),
                 27);
    LayerGeometry layers;
    layers.blocks.push_back(block);
    const MatrixMesh mesh(layers, 1, law);
    double           off = 0;
    for (unsigned int k = 0; k <= fine.n_cells[2]; ++k)
      for (unsigned int j = 0; j <= fine.n_cells[1]; ++j)
        for (unsigned int i = 0; i <= fine.n_cells[0]; ++i)
          {
            const std::array<unsigned int, 3> place{{i, j, k}};
            std::array<unsigned int, 3>       cell;
            CellPoint                         point;
            for (unsigned int d = 0; d < 3; ++d)
              {
                cell[d] = std::min(place[d] / 3, block.n_cells[d] - 1);
                point.coordinates[d] = place[d] / 3. - cell[d];
              }
            point.cell = cell[0] + block.n_cells[0] *
                                     (cell[1] + block.n_cells[1] * cell[2]);
            const auto values = mesh.shape_values(point);
            Vector3    vertex = fine.vertex(i, j, k);
            for (unsigned int a = 0; a < values.size(); ++a)
              vertex -= values[a] * mesh.reference().segment<3>(
                                      3 * mesh.nodes(point.cell)[a]);
            off = std::max(off, vertex.norm());
          }
    checks.below("vertices off where the map of the coarse cell has them",
                 off,
                 1e-12);
  }

  void
  check_repair(Checks &checks, const FiberMesh &fibers)
  {
    LayerBlock block =
      build_layers(parameters(Layers::upper), fibers, fibers.reference())
        .blocks[0];
    checks.above("worst corner", worst_corner(block), .2);
    const LayerBlock good = block;
    checks.that("good cells stay as they are",
                repair(block, 0) && block.vertices == good.vertices);
    // A spike from the inner face through the outer one.
    for (unsigned int k = 0; k < 2; ++k)
      block.vertices[3 * block.index(6, 1, k) + 2] += 8 - 4 * k;
    checks.below("worst corner with a spike", worst_corner(block) + 1, 1.2);
    checks.that("a spike is repaired", repair(block, 0));
    checks.above("worst corner then", worst_corner(block), .2);
    const MatrixMesh mesh({{block}}, 1, law);
    checks.below("the outer face stays",
                 block.vertex(6, 1, 2).z() - good.vertex(6, 1, 2).z(),
                 1e-12);
  }

  void
  check_refused(Checks &checks, const FiberMesh &fibers)
  {
    const auto refused = [&](const MatrixParameters &matrix,
                             const std::string      &text) {
      try
        {
          build_layers(matrix, fibers, fibers.reference());
        }
      catch (const InputError &error)
        {
          return std::string(error.what()).find(text) != std::string::npos;
        }
      return false;
    };
    MatrixParameters deep = parameters(Layers::both);
    deep.overlap          = 2;
    checks.that("layers that meet are refused", refused(deep, "meet"));
    MatrixParameters flat = parameters(Layers::upper);
    flat.thickness        = -2;
    checks.that("cells that stay bad are refused", refused(flat, "rough"));
  }
} // namespace

int
main()
{
  std::ofstream   output("output");
  Checks          checks(output);
  const FiberSet  fibers = waves();
  const FiberMesh mesh(fibers);
  check_faces(checks, mesh);
  check_thin_places(checks);
  check_location(checks, mesh);
  check_subdivision(checks, mesh);
  check_repair(checks, mesh);
  check_refused(checks, mesh);
}
