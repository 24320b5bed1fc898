// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// What leaves for other programs: surfaces of tows are closed and apart where
// the hulls of their fibers are not, voxels have the volume of the fibers, a
// deck has every element once, TexGen's model every section, and lines of VTK
// are read back.

#include <fiberloom/fabric/xml_scanner.h>

#include <fiberloom/output/fabric_measures.h>
#include <fiberloom/output/fiber_lines.h>
#include <fiberloom/output/texgen.h>
#include <fiberloom/output/tow_surface.h>
#include <fiberloom/output/voxel_deck.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <sstream>

#include "checks.h"
#include "woven_sample.h"

using namespace fiberloom;

namespace
{
  constexpr double radius = .008;

  /** Every edge is run along once in each direction. */
  bool
  is_closed(const TowSurface &surface)
  {
    std::map<std::pair<unsigned int, unsigned int>, int> edges;
    for (const auto &t : surface.triangles)
      for (unsigned int c = 0; c < 3; ++c)
        ++edges[{t[c], t[(c + 1) % 3]}];
    return !edges.empty() &&
           std::all_of(edges.begin(), edges.end(), [&](const auto &edge) {
             const auto other =
               edges.find({edge.first.second, edge.first.first});
             return edge.second == 1 && other != edges.end();
           });
  }

  double
  volume(const TowSurface &surface)
  {
    double sum = 0;
    for (const auto &t : surface.triangles)
      sum += surface.points[t[0]].dot(
               surface.points[t[1]].cross(surface.points[t[2]])) /
             6;
    return sum;
  }

  /** By the number of triangles above; not along the lines of any lattice. */
  class InsideTest
  {
  public:
    explicit InsideTest(const TowSurface &surface)
      : triangles(surface.triangles)
    {
      for (const Vector3 &x : surface.points)
        {
          points.push_back(turn * x);
          low  = low.cwiseMin(x);
          high = high.cwiseMax(x);
        }
    }

    bool
    operator()(const Vector3 &point) const
    {
      if ((point - low).minCoeff() < 0 || (high - point).minCoeff() < 0)
        return false;
      const Vector3 x       = turn * point;
      unsigned int  n_above = 0;
      for (const auto &t : triangles)
        {
          const Vector3 &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
          const auto     side = [&x](const Vector3 &from, const Vector3 &to) {
            return (to[0] - from[0]) * (x[1] - from[1]) -
                   (to[1] - from[1]) * (x[0] - from[0]);
          };
          const double ab = side(a, b), bc = side(b, c), ca = side(c, a);
          if ((ab > 0) != (bc > 0) || (bc > 0) != (ca > 0))
            continue;
          n_above +=
            (bc * a[2] + ca * b[2] + ab * c[2]) / (ab + bc + ca) > x[2];
        }
      return n_above % 2 == 1;
    }

  private:
    const Eigen::AngleAxisd turn =
      Eigen::AngleAxisd(.7, Vector3(.3, .5, .2).normalized());
    const std::vector<std::array<unsigned int, 3>> triangles;
    std::vector<Vector3>                           points;
    Vector3 low = Vector3::Constant(1e300), high = -low;
  };

  unsigned int
  corners_inside_others(const std::vector<TowSurface> &surfaces)
  {
    unsigned int n_inside = 0;
    for (std::size_t t = 0; t < surfaces.size(); ++t)
      {
        const InsideTest inside(surfaces[t]);
        for (std::size_t s = 0; s < surfaces.size(); ++s)
          if (s != t)
            n_inside += std::count_if(surfaces[s].points.begin(),
                                      surfaces[s].points.end(),
                                      inside);
      }
    return n_inside;
  }

  /** Points of a lattice in more than one hull. */
  unsigned int
  points_in_two(const std::vector<TowShape> &shapes)
  {
    const auto                         box = enclosing_box(shapes);
    const Lattice                      lattice{box[0], radius, {{100, 70, 12}}};
    std::vector<std::set<std::size_t>> owners(lattice.size());
    for (std::size_t t = 0; t < shapes.size(); ++t)
      shapes[t].visit(lattice,
                      0,
                      [&](const Lattice::Index &i, const TowShape::Value &) {
                        owners[lattice.number(i)].insert(t);
                      });
    return std::count_if(owners.begin(), owners.end(), [](const auto &tows) {
      return tows.size() > 1;
    });
  }

  void
  check_surfaces(Checks                        &checks,
                 const std::vector<TowShape>   &shapes,
                 const std::vector<TowSurface> &surfaces,
                 const VoxelGrid               &grid)
  {
    checks.above("hulls overlap: points in two of them",
                 points_in_two(shapes),
                 10);
    checks.that("each surface is closed",
                std::all_of(surfaces.begin(), surfaces.end(), is_closed));
    checks.equal("corners inside another surface",
                 corners_inside_others(surfaces),
                 0);
    double largest = 0;
    for (std::size_t t = 0; t < surfaces.size(); ++t)
      {
        const auto n = std::count(grid.tows.begin(), grid.tows.end(), int(t));
        largest =
          std::max(largest,
                   std::abs(volume(surfaces[t]) / (n * grid.cube()) - 1));
      }
    checks.below("volume of a surface and of the voxels of its tow",
                 largest,
                 .06);
  }

  void
  check_voxels(Checks                      &checks,
               const WovenSample           &sample,
               const std::vector<TowShape> &shapes)
  {
    double expected = 0;
    for (unsigned int f = 0; f < sample.mesh.lines().size(); ++f)
      expected +=
        fiber_volume(sample.mesh,
                     sample.q,
                     f,
                     {{0., double(sample.mesh.lines()[f].n_elements)}});
    for (const double size : {radius, 3 * radius})
      {
        const VoxelGrid grid = fill_voxels(sample.mesh, sample.q, shapes, size);
        const std::string name =
          "voxels of " + std::to_string(int(size / radius + .5)) + " r: ";
        const auto sum = [](const std::vector<double> &values) {
          return std::accumulate(values.begin(), values.end(), 0.);
        };
        checks.below(name + "volume",
                     grid.cube() * sum(grid.fractions) / expected - 1,
                     2e-4);
        checks.below(name + "volumes of tows",
                     sum(grid.tow_volumes) / expected - 1,
                     2e-4);
        bool unit = true;
        for (std::size_t v = 0; v < grid.tows.size(); ++v)
          unit = unit &&
                 std::abs(grid.orientations[v].norm() -
                          (grid.tows[v] >= 0 || grid.fractions[v] > 0)) < 1e-9;
        checks.that(name + "directions where there are tows", unit);
      }
  }

  void
  check_deck(Checks &checks, const VoxelGrid &grid, const FiberSet &fibers)
  {
    std::istringstream  deck(voxel_deck(grid, fibers, {3000, .35}));
    std::multiset<long> members;
    std::map<std::string, std::vector<long>> node_sets;
    std::vector<long>                       *numbers     = nullptr;
    bool                                     in_set      = false;
    std::size_t                              n_elements  = 0;
    bool                                     in_elements = false;
    for (std::string line; std::getline(deck, line);)
      if (line[0] == '*')
        {
          in_elements = line.rfind("*ELEMENT,", 0) == 0;
          in_set      = line.rfind("*ELSET", 0) == 0;
          numbers     = line.rfind("*NSET", 0) == 0 ?
                          &node_sets[line.substr(line.find('=') + 1)] :
                          nullptr;
        }
      else if (in_elements)
        ++n_elements;
      else if (in_set || numbers != nullptr)
        {
          std::istringstream cells(line);
          for (std::string cell; std::getline(cells, cell, ',');)
            if (in_set)
              members.insert(std::stol(cell));
            else
              numbers->push_back(std::stol(cell));
        }
    checks.equal("deck: elements over voxels",
                 double(n_elements) / grid.tows.size(),
                 1);
    checks.that("deck: each element is in one set",
                members.size() == n_elements && *members.begin() == 1 &&
                  *members.rbegin() == long(n_elements) &&
                  std::set<long>(members.begin(), members.end()).size() ==
                    n_elements);
    bool       matching = !node_sets["FACE_X0"].empty();
    const auto match    = [&](const std::string &first,
                           const std::string &second) {
      const auto &a = node_sets[first], &b = node_sets[second];
      matching = matching && a.size() == b.size();
      for (std::size_t i = 0; matching && i < a.size(); ++i)
        matching = b[i] - a[i] == b[0] - a[0];
    };
    match("FACE_X0", "FACE_X1");
    match("FACE_Y0", "FACE_Y1");
    match("EDGE_Y0_Z0", "EDGE_Y1_Z1");
    match("CORNER_X0_Y0_Z0", "CORNER_X1_Y1_Z1");
    checks.that("deck: nodes of opposite sides match", matching);

    const Fiber       &fiber = fibers.fibers[0];
    const TowConstants none  = tow_constants(fiber, {3000, .35}, 0),
                       half  = tow_constants(fiber, {3000, .35}, .5),
                       all   = tow_constants(fiber, {3000, .35}, 1);
    checks.equal("tow without fibers: modulus", none.young_modulus_2, 3000);
    checks.equal("tow without fibers: Poisson's ratio",
                 none.poisson_ratio_23,
                 .35);
    checks.equal("tow of fibers: shear modulus",
                 all.shear_modulus_12 / (73000 / 2.44),
                 1);
    checks.equal("half and half: along", half.young_modulus_1, 38000);
  }

  void
  check_texgen(Checks &checks, const WovenSample &sample)
  {
    const std::string text = texgen_xml(sample.fibers, sample.mesh, sample.q);
    XmlScanner        scanner(text);
    std::map<std::string, unsigned int> count;
    for (auto piece = scanner.next(); piece != XmlScanner::Piece::end;
         piece      = scanner.next())
      if (piece == XmlScanner::Piece::opening)
        ++count[scanner.name()];
    checks.equal("TexGen: yarns", count["Yarn"], 5);
    // Nodes of a warp and of a fill fiber, which have 12 and 8 elements.
    checks.equal("TexGen: nodes", count["MasterNode"], 2 * 25 + 3 * 17);
    checks.equal("TexGen: sections", count["Section"], count["MasterNode"]);
  }

  void
  check_lines(Checks &checks, const WovenSample &sample)
  {
    std::ofstream("lines.vtp", std::ios::binary)
      << fibers_vtp(sample.fibers, sample.mesh, sample.q);
    const FiberSet found = build_fiber_set(
      parsed_scene("set Stages = load\nset Drives = d\nsubsection Drive d\n"
                   "set Ends = 0 start\nend\nsubsection Fibers\n"
                   "set File = lines.vtp\nend\n"));
    checks.equal("lines: fibers", found.fibers.size(), 35);
    checks.equal("lines: radius", found.fibers[34].radius, radius);
    const auto &line = sample.mesh.lines()[34];
    checks.below("lines: end",
                 (found.fibers[34].centers.back() -
                  sample.q.segment<3>(9 *
                                      (line.first_node + line.n_nodes() - 1)))
                   .norm(),
                 1e-12);
  }
} // namespace

int
main()
{
  std::ofstream     output("output");
  Checks            checks(output);
  const WovenSample sample;
  const auto        shapes = tow_shapes(sample.fibers, sample.mesh, sample.q);
  const VoxelGrid   grid   = fill_voxels(sample.mesh, sample.q, shapes, radius);
  check_surfaces(checks, shapes, tow_surfaces(shapes, radius), grid);
  check_voxels(checks, sample, shapes);
  check_deck(checks, grid, sample.fibers);
  check_texgen(checks, sample);
  check_lines(checks, sample);
}
