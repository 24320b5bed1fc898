// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/output/voxel_deck.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace fiberloom
{
  namespace
  {
    constexpr double pull = 1e-3; // strain of the step

    class DeckWriter
    {
    public:
      DeckWriter(const VoxelGrid       &grid,
                 const FiberSet        &fibers,
                 const MatrixConstants &matrix)
        : grid(grid)
        , fibers(fibers)
        , matrix(matrix)
        , nodes(grid.centers)
        , elements(fibers.tows.size() + 1)
      {
        nodes.origin -= Vector3::Constant(.5 * nodes.spacing);
        for (int &n : nodes.n)
          ++n;
        for (std::size_t v = 0; v < grid.tows.size(); ++v)
          elements[grid.tows[v] < 0 ? fibers.tows.size() : grid.tows[v]]
            .push_back(v + 1);
        out << std::setprecision(9);
      }

      std::string
      write()
      {
        out << "*HEADING\nFabric in a matrix by fiberloom, in mm, N, MPa\n";
        write_nodes();
        write_elements();
        for (std::size_t t = 0; t < elements.size(); ++t)
          write_set("ELSET", name_of(t), elements[t]);
        write_node_sets();
        write_orientations();
        for (std::size_t t = 0; t < elements.size(); ++t)
          write_section(t);
        write_step();
        return out.str();
      }

    private:
      const VoxelGrid                      &grid;
      const FiberSet                       &fibers;
      const MatrixConstants                &matrix;
      Lattice                               nodes;
      std::vector<std::vector<std::size_t>> elements; // of tows, of the matrix
      std::ostringstream                    out;

      std::string
      name_of(const std::size_t set) const
      {
        return set < fibers.tows.size() ? "TOW_" + std::to_string(set) :
                                          "MATRIX";
      }

      std::size_t
      node(const int x, const int y, const int z) const
      {
        return nodes.number({{x, y, z}}) + 1;
      }

      void
      write_nodes()
      {
        out << "*NODE, NSET=ALL_NODES\n";
        for (int z = 0; z < nodes.n[2]; ++z)
          for (int y = 0; y < nodes.n[1]; ++y)
            for (int x = 0; x < nodes.n[0]; ++x)
              {
                const Vector3 p = nodes.point({{x, y, z}});
                out << node(x, y, z) << ", " << p[0] << ", " << p[1] << ", "
                    << p[2] << "\n";
              }
      }

      void
      write_elements()
      {
        out << "*ELEMENT, TYPE=C3D8, ELSET=ALL_ELEMENTS\n";
        const auto &n = grid.centers.n;
        for (int z = 0; z < n[2]; ++z)
          for (int y = 0; y < n[1]; ++y)
            for (int x = 0; x < n[0]; ++x)
              {
                out << grid.centers.number({{x, y, z}}) + 1;
                for (const int up : {0, 1})
                  out << ", " << node(x, y, z + up) << ", "
                      << node(x + 1, y, z + up) << ", "
                      << node(x + 1, y + 1, z + up) << ", "
                      << node(x, y + 1, z + up);
                out << "\n";
              }
      }

      /** Leaves out empty sets. */
      void
      write_set(const std::string              &kind,
                const std::string              &name,
                const std::vector<std::size_t> &members)
      {
        constexpr std::size_t in_a_line = 16;
        if (members.empty())
          return;
        // Of opposite sides the numbers are in the same order.
        out << "*" << kind << ", " << kind << "=" << name << "\n";
        for (std::size_t i = 0; i < members.size(); ++i)
          out << members[i]
              << (i % in_a_line + 1 == in_a_line || i + 1 == members.size() ?
                    "\n" :
                    ", ");
      }

      /**
       * Nodes that are on the sides of the box that @p sides asks for in each
       * direction: 0 or 1 the first or last, 2 between, 3 any.
       */
      std::vector<std::size_t>
      nodes_on(const std::array<int, 3> &sides) const
      {
        std::array<int, 3> low, high;
        for (unsigned int d = 0; d < 3; ++d)
          {
            const int last = nodes.n[d] - 1;
            low[d]         = sides[d] == 1 ? last : sides[d] == 2 ? 1 : 0;
            high[d] = sides[d] == 0 ? 0 : sides[d] == 2 ? last - 1 : last;
          }
        std::vector<std::size_t> found;
        for (int z = low[2]; z <= high[2]; ++z)
          for (int y = low[1]; y <= high[1]; ++y)
            for (int x = low[0]; x <= high[0]; ++x)
              found.push_back(node(x, y, z));
        return found;
      }

      /** Whole faces, and faces, edges and corners that share no node. */
      void
      write_node_sets()
      {
        const std::string axes = "XYZ";
        for (unsigned int d = 0; d < 3; ++d)
          for (const int side : {0, 1})
            {
              std::array<int, 3> sides = {{3, 3, 3}};
              sides[d]                 = side;
              write_set("NSET",
                        axes[d] + std::to_string(side),
                        nodes_on(sides));
            }
        std::array<int, 3> sides;
        for (sides[0] = 0; sides[0] < 3; ++sides[0])
          for (sides[1] = 0; sides[1] < 3; ++sides[1])
            for (sides[2] = 0; sides[2] < 3; ++sides[2])
              {
                std::string        name;
                const unsigned int n_between =
                  std::count(sides.begin(), sides.end(), 2);
                for (unsigned int d = 0; d < 3; ++d)
                  if (sides[d] < 2)
                    name +=
                      std::string("_") + axes[d] + std::to_string(sides[d]);
                if (n_between < 3)
                  write_set("NSET",
                            (n_between == 2 ? "FACE" :
                             n_between == 1 ? "EDGE" :
                                              "CORNER") +
                              name,
                            nodes_on(sides));
              }
      }

      /** The first axis along the fibers, the second in the plane if it can. */
      void
      write_orientations()
      {
        out << "*DISTRIBUTION TABLE, NAME=DIRECTION_TABLE\nCOORD3D, COORD3D\n"
            << "*DISTRIBUTION, NAME=DIRECTIONS, LOCATION=ELEMENT, "
               "TABLE=DIRECTION_TABLE\n, 1., 0., 0., 0., 1., 0.\n";
        for (std::size_t v = 0; v < grid.tows.size(); ++v)
          if (grid.tows[v] >= 0)
            {
              const Vector3 &along  = grid.orientations[v];
              const Vector3  across = along.head<2>().norm() > .1 ?
                                        Vector3::UnitZ().cross(along) :
                                        Vector3::UnitY().cross(along);
              out << v + 1;
              for (const double x : {along[0],
                                     along[1],
                                     along[2],
                                     across[0],
                                     across[1],
                                     across[2]})
                out << ", " << x;
              out << "\n";
            }
        out << "*ORIENTATION, NAME=FIBERS, SYSTEM=RECTANGULAR\nDIRECTIONS\n";
      }

      void
      write_section(const std::size_t set)
      {
        if (elements[set].empty())
          return;
        const std::string name = name_of(set);
        out << "*MATERIAL, NAME=" << name << "\n*ELASTIC";
        if (set == fibers.tows.size())
          out << "\n"
              << matrix.young_modulus << ", " << matrix.poisson_ratio << "\n";
        else
          {
            const double fraction =
              grid.tow_volumes[set] / (grid.cube() * elements[set].size());
            const TowConstants c =
              tow_constants(fibers.fibers[fibers.tows[set].fibers[0]],
                            matrix,
                            std::min(fraction, 1.));
            out << ", TYPE=ENGINEERING CONSTANTS\n"
                << c.young_modulus_1 << ", " << c.young_modulus_2 << ", "
                << c.young_modulus_2 << ", " << c.poisson_ratio_12 << ", "
                << c.poisson_ratio_12 << ", " << c.poisson_ratio_23 << ", "
                << c.shear_modulus_12 << ", " << c.shear_modulus_12 << "\n"
                << c.shear_modulus_23 << "\n";
          }
        out << "*SOLID SECTION, ELSET=" << name << ", MATERIAL=" << name
            << (set < fibers.tows.size() ? ", ORIENTATION=FIBERS" : "") << "\n";
      }

      void
      write_step()
      {
        const double length = (nodes.n[0] - 1) * nodes.spacing;
        out << "*STEP\n*STATIC\n*BOUNDARY\nX0, 1, 1, 0.\nY0, 2, 2, 0.\n"
               "Z0, 3, 3, 0.\nX1, 1, 1, "
            << pull * length
            << "\n*NODE PRINT, NSET=X1, TOTALS=ONLY\nRF\n*NODE FILE\nU\n"
               "*END STEP\n";
      }
    };
  } // namespace



  TowConstants
  tow_constants(const Fiber           &fiber,
                const MatrixConstants &matrix,
                const double           fraction)
  {
    const double fiber_shear =
                   fiber.young_modulus / (2 * (1 + fiber.poisson_ratio)),
                 matrix_shear =
                   matrix.young_modulus / (2 * (1 + matrix.poisson_ratio));
    const auto across = [fraction](const double in_matrix,
                                   const double in_fiber) {
      return in_matrix / (1 - std::sqrt(fraction) * (1 - in_matrix / in_fiber));
    };
    const auto along = [fraction](const double in_matrix,
                                  const double in_fiber) {
      return fraction * in_fiber + (1 - fraction) * in_matrix;
    };
    TowConstants c;
    c.young_modulus_1  = along(matrix.young_modulus, fiber.young_modulus);
    c.young_modulus_2  = across(matrix.young_modulus, fiber.young_modulus);
    c.poisson_ratio_12 = along(matrix.poisson_ratio, fiber.poisson_ratio);
    c.shear_modulus_12 = across(matrix_shear, fiber_shear);
    c.shear_modulus_23 = c.shear_modulus_12;
    c.poisson_ratio_23 = c.young_modulus_2 / (2 * c.shear_modulus_23) - 1;
    return c;
  }



  std::string
  voxel_deck(const VoxelGrid       &grid,
             const FiberSet        &fibers,
             const MatrixConstants &matrix)
  {
    return DeckWriter(grid, fibers, matrix).write();
  }
} // namespace fiberloom
