// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/matrix/woven_surface.h>

#include <fiberloom/coupling/junction.h>

#include <algorithm>
#include <cmath>

namespace fiberloom
{
  JunctionElement::JunctionElement(const Junction   &junction,
                                   const FiberMesh  &fibers,
                                   const MatrixMesh &matrix)
    : stiffness(junction.stiffness)
    , nodes_of_matrix(matrix.nodes(junction.place.cell))
  {
    const unsigned int first = fibers.first_node(junction.point.element);
    const auto         N     = fiberloom::shape_values(junction.point.xi);
    for (unsigned int a = 0; a < 3; ++a)
      {
        nodes_of_fiber[a] = first + a;
        for (const double component :
             {1., junction.particle[0], junction.particle[1]})
          vector_weights.push_back(N[a] * component);
      }
    for (const double value : matrix.shape_values(junction.place))
      vector_weights.push_back(-value);
    for (const unsigned int axis : {0, 1})
      if (const int n = junction.periods[axis]; n != 0)
        {
          const auto [image, original] = matrix.period(axis);
          nodes_of_matrix.insert(nodes_of_matrix.end(), {image, original});
          vector_weights.insert(vector_weights.end(), {-1. * n, 1. * n});
        }
  }



  Vector3
  JunctionElement::fiber_particle(const DofVector &q) const
  {
    Vector3 position = Vector3::Zero();
    for (unsigned int a = 0; a < 3; ++a)
      for (unsigned int v = 0; v < 3; ++v)
        position += vector_weights[3 * a + v] *
                    q.segment<3>(9 * nodes_of_fiber[a] + 3 * v);
    return position;
  }



  Vector3
  JunctionElement::matrix_particle(const Eigen::VectorXd &x) const
  {
    Vector3 position = Vector3::Zero();
    for (unsigned int b = 0; b < nodes_of_matrix.size(); ++b)
      position -= vector_weights[9 + b] * x.segment<3>(3 * nodes_of_matrix[b]);
    return position;
  }



  double
  shear_lag_stiffness(const double young_modulus,
                      const double poisson_ratio,
                      const double distance_over_radius)
  {
    const double shear_modulus = young_modulus / (2 * (1 + poisson_ratio));
    return 2 * M_PI * shear_modulus / std::log(distance_over_radius);
  }



  namespace
  {
    /** Heights of the skins seen closely, to tell what lies on the surface. */
    class CloseSurface
    {
    public:
      CloseSurface(const FiberMesh &fibers, const DofVector &q, const Side side)
        : sign(side == Side::upper ? 1 : -1)
      {
        const Extent extent = fabric_extent(fibers, q);
        for (const unsigned int c : {0, 1})
          {
            const double size = extent.high[c] - extent.low[c];
            const int    n =
              std::max(1., std::round(size / (2 * fibers.largest_radius())));
            for (int i = 0; i <= n; ++i)
              lines[c].push_back(extent.low[c] + size * i / n);
          }
        heights = surface_heights(fibers, q, side, lines[0], lines[1]);
      }

      bool
      is_within(const Vector3 &position, const double depth) const
      {
        std::array<unsigned int, 2> vertex;
        for (const unsigned int c : {0, 1})
          {
            const auto  &l = lines[c];
            const double t = (position[c] - l[0]) / (l[1] - l[0]);
            vertex[c] = std::clamp(std::round(t), 0., double(l.size() - 1));
          }
        const double height = heights[vertex[0] + lines[0].size() * vertex[1]];
        return sign * (height - position.z()) <= depth;
      }

    private:
      const double                       sign;
      std::array<std::vector<double>, 2> lines;
      std::vector<double>                heights;
    };

    template <class Visit>
    void
    visit_stations(const FiberMesh &fibers,
                   const double     spacing,
                   const Visit     &visit)
    {
      for (unsigned int f = 0; f < fibers.lines().size(); ++f)
        {
          const auto &line = fibers.lines()[f];
          const int   n    = std::max(1., std::round(line.length / spacing));
          for (int i = 0; i < n; ++i)
            visit(fibers.locate(f, (i + .5) * line.n_elements / n),
                  line.length / n);
        }
    }
  } // namespace



  FoundJunctions
  find_junctions(const MatrixParameters &parameters,
                 const FiberMesh        &fibers,
                 const MatrixMesh       &matrix,
                 const DofVector        &q)
  {
    const double   per_length = parameters.junction_stiffness > 0 ?
                                  parameters.junction_stiffness :
                                  shear_lag_stiffness(parameters.young_modulus,
                                                    parameters.poisson_ratio,
                                                    parameters.junction_reach);
    FoundJunctions found;
    const auto     join = [&](const ElementPoint          &point,
                          const std::array<double, 2> &particle,
                          const double                 length,
                          const auto                  &should_be_inside) {
      const Section section = fibers.section(q, point);
      Vector3       position = section.center + particle[0] * section.vector_1 +
                         particle[1] * section.vector_2;
      std::array<int, 2> periods{{0, 0}};
      if (!fibers.originals().empty())
        periods = matrix.move_to_cell(position);
      if (const auto place = matrix.locate(position))
        found.junctions.push_back(
          {point, particle, *place, per_length * length, periods});
      else if (should_be_inside(position))
        {
          ++found.n_outside;
          found.an_outside_place = position;
        }
    };

    if (parameters.layers == Layers::filled)
      {
        visit_stations(fibers,
                       parameters.junction_spacing,
                       [&](const ElementPoint &point, const double length) {
                         join(point, {{0., 0.}}, length, [](const Vector3 &) {
                           return true;
                         });
                       });
        return found;
      }

    for (const Side side : {Side::lower, Side::upper})
      {
        if (parameters.layers ==
            (side == Side::lower ? Layers::upper : Layers::lower))
          continue;
        const CloseSurface surface(fibers, q, side);
        visit_stations(fibers,
                       parameters.junction_spacing,
                       [&](const ElementPoint &point, const double length) {
                         join(point,
                              outermost_particle(fibers.section(q, point),
                                                 side),
                              length,
                              [&](const Vector3 &position) {
                                return surface.is_within(position,
                                                         parameters.overlap);
                              });
                       });
      }
    return found;
  }
} // namespace fiberloom
