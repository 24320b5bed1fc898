// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/output/tow_surface.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace fiberloom
{
  namespace
  {
    // Over the spacing of the lattice: tows are apart by the gap, values
    // nearer to 0 than the least make no triangles without area.
    constexpr double gap_over_spacing   = .05;
    constexpr double least_over_spacing = 1e-4;

    // Around the body, over the spacing: more than the diagonal of a cube.
    constexpr double margin_over_spacing = 2;

    /** The six tetrahedra of a cube around its diagonal; neighbouring cubes
     * share the diagonals of their faces. Bits of a corner are x, y, z. */
    constexpr std::array<std::array<unsigned int, 4>, 6> tetrahedra = {
      {{{0, 1, 3, 7}},
       {{0, 3, 2, 7}},
       {{0, 2, 6, 7}},
       {{0, 6, 4, 7}},
       {{0, 4, 5, 7}},
       {{0, 5, 1, 7}}}};

    /** Marching tetrahedra: values are linear in each of them, so that surfaces
     * of tows that are apart at the points are apart. VTK's contours of images
     * march through cubes, whose triangles do not promise that. */
    class SurfaceBuilder
    {
    public:
      SurfaceBuilder(const Lattice &lattice, const std::vector<float> &levels)
        : lattice(lattice)
        , levels(levels)
      {
        Lattice::Index i;
        for (i[2] = 0; i[2] + 1 < lattice.n[2]; ++i[2])
          for (i[1] = 0; i[1] + 1 < lattice.n[1]; ++i[1])
            for (i[0] = 0; i[0] + 1 < lattice.n[0]; ++i[0])
              add_cube(i);
      }

      TowSurface surface;

    private:
      struct Node
      {
        std::size_t number;
        Vector3     position;
        double      level;
      };

      const Lattice                                &lattice;
      const std::vector<float>                     &levels;
      std::unordered_map<std::size_t, unsigned int> points; // by edge

      void
      add_cube(const Lattice::Index &i)
      {
        std::array<Node, 8> corners;
        unsigned int        n_inside = 0;
        for (unsigned int c = 0; c < 8; ++c)
          {
            const Lattice::Index at = {{i[0] + static_cast<int>(c & 1),
                                        i[1] + static_cast<int>(c >> 1 & 1),
                                        i[2] + static_cast<int>(c >> 2)}};
            corners[c].number       = lattice.number(at);
            corners[c].level        = levels[corners[c].number];
            n_inside += corners[c].level < 0;
          }
        if (n_inside == 0 || n_inside == 8)
          return;
        for (unsigned int c = 0; c < 8; ++c)
          corners[c].position =
            lattice.point({{i[0] + static_cast<int>(c & 1),
                            i[1] + static_cast<int>(c >> 1 & 1),
                            i[2] + static_cast<int>(c >> 2)}});
        for (const auto &tetrahedron : tetrahedra)
          add_tetrahedron(corners, tetrahedron);
      }

      void
      add_tetrahedron(const std::array<Node, 8>         &corners,
                      const std::array<unsigned int, 4> &tetrahedron)
      {
        std::vector<const Node *> in, out;
        for (const unsigned int c : tetrahedron)
          (corners[c].level < 0 ? in : out).push_back(&corners[c]);
        if (in.empty() || out.empty())
          return;
        const Vector3 outward = mean(out) - mean(in);
        if (in.size() == 2)
          {
            const unsigned int a = point(*in[0], *out[0]),
                               b = point(*in[0], *out[1]),
                               c = point(*in[1], *out[1]),
                               d = point(*in[1], *out[0]);
            add_triangle(a, b, c, outward);
            add_triangle(a, c, d, outward);
            return;
          }
        const Node &tip  = in.size() == 1 ? *in[0] : *out[0];
        const auto &base = in.size() == 1 ? out : in;
        add_triangle(point(tip, *base[0]),
                     point(tip, *base[1]),
                     point(tip, *base[2]),
                     outward);
      }

      static Vector3
      mean(const std::vector<const Node *> &nodes)
      {
        Vector3 sum = Vector3::Zero();
        for (const Node *node : nodes)
          sum += node->position / nodes.size();
        return sum;
      }

      /** Where the level is 0 between two nodes. */
      unsigned int
      point(const Node &a, const Node &b)
      {
        const Node &first = a.number < b.number ? a : b,
                   &last  = a.number < b.number ? b : a;
        // A node's seven edges upwards go to the corners of its cube.
        const std::size_t direction = last.number - first.number;
        const std::size_t row = lattice.n[0], layer = row * lattice.n[1];
        const std::size_t z = direction / layer, y = direction % layer / row,
                          x        = direction % row;
        const auto [found, is_new] = points.insert(
          {8 * first.number + (x + 2 * y + 4 * z), surface.points.size()});
        if (is_new)
          surface.points.push_back(first.position +
                                   first.level / (first.level - last.level) *
                                     (last.position - first.position));
        return found->second;
      }

      void
      add_triangle(const unsigned int a,
                   const unsigned int b,
                   const unsigned int c,
                   const Vector3     &outward)
      {
        const auto   &x      = surface.points;
        const Vector3 normal = (x[b] - x[a]).cross(x[c] - x[a]);
        if (normal.dot(outward) > 0)
          surface.triangles.push_back({{a, b, c}});
        else
          surface.triangles.push_back({{a, c, b}});
      }
    };

    Lattice
    lattice_around(const std::array<Vector3, 2> &box, const Lattice &whole)
    {
      const int  border = std::lround(margin_over_spacing) + 1;
      Lattice    part   = whole;
      const auto low = whole.nearest(box[0]), high = whole.nearest(box[1]);
      part.origin =
        whole.point({{low[0] - border, low[1] - border, low[2] - border}});
      for (unsigned int d = 0; d < 3; ++d)
        part.n[d] = high[d] - low[d] + 2 * border + 1;
      return part;
    }

    TowSurface
    tow_surface(const TowShape &shape, const int tow, const TowRegions &regions)
    {
      const Lattice &whole   = regions.points();
      const double   spacing = whole.spacing;
      const Lattice  lattice = lattice_around(shape.box(), whole);
      const auto     first   = whole.nearest(lattice.origin);
      const double   margin  = regions.known_up_to();
      const double   least   = least_over_spacing * spacing;

      std::vector<float> levels(lattice.size(), margin);
      shape.visit(lattice,
                  margin,
                  [&](const Lattice::Index &i, const TowShape::Value &value) {
                    double level = regions.level(
                      tow,
                      {{i[0] + first[0], i[1] + first[1], i[2] + first[2]}},
                      value);
                    if (std::abs(level) < least)
                      level = level < 0 ? -least : least;
                    float &at = levels[lattice.number(i)];
                    at        = std::min<float>(at, level);
                  });
      return level_surface(lattice, levels);
    }
  } // namespace



  TowSurface
  level_surface(const Lattice &lattice, const std::vector<float> &levels)
  {
    return SurfaceBuilder(lattice, levels).surface;
  }



  std::vector<TowSurface>
  tow_surfaces(const std::vector<TowShape> &shapes, const double spacing)
  {
    const TowRegions        regions(shapes,
                             lattice_around(enclosing_box(shapes),
                                            {Vector3::Zero(), spacing, {}}),
                             gap_over_spacing * spacing,
                             margin_over_spacing * spacing);
    std::vector<TowSurface> surfaces;
    for (std::size_t t = 0; t < shapes.size(); ++t)
      surfaces.push_back(tow_surface(shapes[t], t, regions));
    return surfaces;
  }
} // namespace fiberloom
