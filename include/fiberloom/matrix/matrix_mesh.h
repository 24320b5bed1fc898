// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_matrix_matrix_mesh_h
#define fiberloom_matrix_matrix_mesh_h

#include <fiberloom/base/choices.h>

#include <fiberloom/fabric/fiber_images.h>

#include <fiberloom/matrix/hex_element.h>
#include <fiberloom/matrix/layer_geometry.h>

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace fiberloom
{
  /**
   * The border across @p axis , 0 to 2, at its start (side 0) or end (side 1).
   */
  inline MatrixBorder
  border_across(const unsigned int axis, const unsigned int side)
  {
    return static_cast<MatrixBorder>(2 * axis + side);
  }

  /** A place in the matrix: a cell and coordinates in [0, 1]^3. */
  struct CellPoint
  {
    unsigned int cell;
    Vector3      coordinates;
  };

  /**
   * The layers of matrix as hexahedra of deal.II with Lagrange elements of
   * degree 1 or 2, block after block, x first. Every rank has all cells, as it
   * has all fibers; who assembles what is decided by who owns its nodes. Node n
   * has the displacements of x, y and z.
   */
  class MatrixMesh
  {
  public:
    /** Meshes the layers of @p geometry with elements of @p degree , 1 or 2. */
    MatrixMesh(const LayerGeometry   &geometry,
               const unsigned int     degree,
               const HyperelasticLaw &law);
    ~MatrixMesh();

    unsigned int
    n_nodes() const
    {
      return stress_free.size() / 3;
    }

    unsigned int
    n_cells() const
    {
      return elements.size();
    }

    /** Stress-free positions of the nodes, three components each [mm]. */
    const Eigen::VectorXd &
    reference() const
    {
      return stress_free;
    }

    /** Nodes of @p cell , in deal.II's order. */
    const std::vector<unsigned int> &
    nodes(const unsigned int cell) const
    {
      return cell_nodes[cell];
    }

    const HexElement &
    element(const unsigned int cell) const
    {
      return elements[cell];
    }

    unsigned int
    degree() const;

    const HyperelasticLaw &
    law() const
    {
      return material;
    }

    /** Mean edge of the cells: volume to the power of 1/3 [mm]. */
    double
    cell_size() const;

    /**
     * A scale for the stiffness of a cell, which is this times a modulus [mm]:
     * the largest of the cells' sums over quadrature points of the volume times
     * the squared gradients of the shape functions.
     */
    double
    largest_slope() const
    {
      return slope;
    }

    /** All nodes on @p border ; none where no layer reaches it. */
    std::vector<unsigned int>
    border_nodes(const MatrixBorder border) const;

    /** What each node is the image of where the layers are those of a periodic
     * cell: nodes at the ends of x and y are images of those at the starts. */
    std::vector<NodeImage>
    originals() const;

    /** A node one period along x or y away from another one, and this one. */
    std::array<unsigned int, 2>
    period(const unsigned int axis) const
    {
      return period_nodes[axis];
    }

    /**
     * Moves @p position by whole periods to the cell; returns by how many it
     * had been beyond it along x and y.
     */
    std::array<int, 2>
    move_to_cell(Vector3 &position) const;

    /** The material point that is at @p position without stress; nothing
     * outside every cell. */
    std::optional<CellPoint>
    locate(const Vector3 &position) const;

    /** Coordinates in a cell of its node number @p node_of_cell . */
    Vector3
    unit_point(const unsigned int node_of_cell) const;

    /** Values at @p point of the shape functions of its cell's nodes. */
    std::vector<double>
    shape_values(const CellPoint &point) const;

    /**
     * Deformation gradient, 3 x 3, at node number @p node_of_cell of @p cell ;
     * @p x : positions of all nodes [mm], as in reference().
     */
    Matrix3
    deformation_gradient(const Eigen::VectorXd &x,
                         const unsigned int     cell,
                         const unsigned int     node_of_cell) const;

    /**
     * Positions of the nodes of @p cell [mm], three components each, where
     * those of all nodes are @p x .
     */
    Eigen::VectorXd
    cell_positions(const Eigen::VectorXd &x, const unsigned int cell) const;

  private:
    /** What deal.II keeps of the mesh. */
    struct Mesh;

    void
    create_cells(const LayerGeometry &geometry);

    void
    set_up_elements();

    /**
     * The one of @p nodes that is nearest to @p node but for the distance along
     * @p axis .
     */
    unsigned int
    nearest_across(const unsigned int               node,
                   const unsigned int               axis,
                   const std::vector<unsigned int> &nodes) const;

    const HyperelasticLaw                      material;
    const std::unique_ptr<Mesh>                mesh;
    std::array<bool, 2>                        has_flat_face{{false, false}};
    Eigen::VectorXd                            stress_free;
    std::array<std::array<unsigned int, 2>, 2> period_nodes;
    std::vector<std::vector<unsigned int>>     cell_nodes;
    std::vector<HexElement>                    elements;
    std::vector<std::vector<HexElement::Gradients>> node_gradients;
    double                                          volume = 0; // [mm^3]
    double                                          slope  = 0; // [mm]
  };
} // namespace fiberloom

#endif
