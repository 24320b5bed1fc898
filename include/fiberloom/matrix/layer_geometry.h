// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_matrix_layer_geometry_h
#define fiberloom_matrix_layer_geometry_h

#include <fiberloom/beams/fiber_mesh.h>

#include <fiberloom/matrix/matrix_parameters.h>
#include <fiberloom/matrix/woven_surface.h>

#include <boost/serialization/array.hpp>
#include <boost/serialization/vector.hpp>

#include <array>
#include <vector>

namespace fiberloom
{
  /** Cells in rows and columns between two faces, edges straight. */
  struct LayerBlock
  {
    std::array<unsigned int, 3> n_cells;  // along x, along y, through thickness
    std::vector<double>         vertices; // x first, then y, then z [mm]

    Vector3
    vertex(const unsigned int i,
           const unsigned int j,
           const unsigned int k) const
    {
      return Eigen::Map<const Vector3>(vertices.data() + 3 * index(i, j, k));
    }

    unsigned int
    index(const unsigned int i,
          const unsigned int j,
          const unsigned int k) const
    {
      return i + (n_cells[0] + 1) * (j + (n_cells[1] + 1) * k);
    }

    template <class Archive>
    void
    serialize(Archive &ar, const unsigned int)
    {
      ar &n_cells &vertices;
    }
  };

  /** @p block with @p n cells along each edge of one of its cells. */
  LayerBlock
  subdivided(const LayerBlock &block, const unsigned int n);

  /** The layers of matrix without stress; empty where there is none. */
  struct LayerGeometry
  {
    std::vector<LayerBlock> blocks;

    template <class Archive>
    void
    serialize(Archive &ar, const unsigned int)
    {
      ar &blocks;
    }
  };

  /** A box along the axes that holds the skins of all fibers [mm]. */
  struct Extent
  {
    Vector3 low, high;
  };

  /** The box that holds the skins of all fibers where their dofs are @p q . */
  Extent
  skin_extent(const FiberMesh &mesh, const DofVector &q);

  /**
   * The same box; in the plane it is that of a periodic cell if there is one.
   * Throws InputError where the cell is sheared.
   */
  Extent
  fabric_extent(const FiberMesh &mesh, const DofVector &q);

  /** Nodes that layers of these parameters will have. */
  unsigned int
  n_layer_nodes(const MatrixParameters &parameters);

  /**
   * The layers on the woven surface of the fibers placed at @p q . An inner
   * face has at each vertex the height of the outermost skin within half a
   * cell around, less the overlap, of two layers at most 0.45 of the fabric's
   * thickness there; outer faces are flat. Inner faces of bad
   * cells are smoothed. Throws InputError where that does not help, and where
   * two layers would meet at most vertices.
   */
  LayerGeometry
  build_layers(const MatrixParameters &parameters,
               const FiberMesh        &mesh,
               const DofVector        &q);

  /**
   * Smallest volume of the three edges at a corner of a cell over that of a
   * box with edges as long: 1 for a box, not positive for a cell that is
   * turned inside out.
   */
  double
  worst_corner(const LayerBlock &block);

  /**
   * Smooths the heights of one face, at @p k_face , of a block with bad corners
   * until there are none; the vertices between follow. Opposite borders
   * that are periodic stay alike. Whether that succeeds.
   */
  bool
  repair(LayerBlock        &block,
         const unsigned int k_face,
         const Borders      borders = Borders::open);
} // namespace fiberloom

#endif
