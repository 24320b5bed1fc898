// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/beams/fiber_mesh.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace fiberloom
{
  struct FiberMesh::Seen
  {
    FiberImages images;
    FiberMesh   mesh;
    std::array<std::array<unsigned int, 2>, 2>
      ends; // nodes one period apart along x, along y

    explicit Seen(const FiberSet &fibers)
      : images(fibers)
      , mesh(images.fibers)
    {}
  };



  namespace
  {
    template <class Nodes>
    Eigen::Matrix<double, 9, 1>
    node_dofs(const Nodes &nodes, const unsigned int n, const double radius)
    {
      Eigen::Matrix<double, 9, 1> dofs;
      dofs << nodes.centers[n], radius * nodes.directions_1[n],
        radius * nodes.directions_2[n];
      return dofs;
    }
  } // namespace



  FiberMesh::FiberMesh(const FiberSet &set)
    : radii{{std::numeric_limits<double>::max(), 0}}
    , stiffness_scale(std::numeric_limits<double>::max())
  {
    unsigned int n_nodes = 0, n_elements = 0;
    for (const Fiber &fiber : set.fibers)
      {
        n_nodes += fiber.centers.size();
        n_elements += fiber.n_elements();
      }
    reference_dofs.resize(dofs_per_node * n_nodes);
    initial_dofs.resize(dofs_per_node * n_nodes);
    beam_elements.reserve(n_elements);
    element_fibers.reserve(n_elements);

    unsigned int node = 0;
    for (const Fiber &fiber : set.fibers)
      {
        Line line{node,
                  static_cast<unsigned int>(beam_elements.size()),
                  fiber.n_elements(),
                  fiber.tow,
                  fiber.radius,
                  fiber.young_modulus,
                  0.};
        radii = {
          {std::min(radii[0], fiber.radius), std::max(radii[1], fiber.radius)}};
        stiffness_scale =
          std::min(stiffness_scale, fiber.young_modulus * fiber.radius);
        for (unsigned int n = 0; n < fiber.centers.size(); ++n, ++node)
          {
            reference_dofs.segment<9>(9 * node) =
              node_dofs(fiber, n, fiber.radius);
            initial_dofs.segment<9>(9 * node) =
              fiber.initial ? node_dofs(*fiber.initial, n, fiber.radius) :
                              node_dofs(fiber, n, fiber.radius);
          }

        for (unsigned int e = 0; e < line.n_elements; ++e)
          {
            beam_elements.emplace_back(reference_dofs.segment<27>(
                                         9 * (line.first_node + 2 * e)),
                                       fiber.radius,
                                       fiber.young_modulus,
                                       fiber.poisson_ratio,
                                       fiber.law);
            element_fibers.push_back(fiber_lines.size());
            line.length += beam_elements.back().length();
          }
        fiber_lines.push_back(line);
      }
    if (set.cell)
      add_images(set);
  }



  void
  FiberMesh::add_images(const FiberSet &fibers)
  {
    auto with_ends = std::make_shared<Seen>(fibers);
    for (unsigned int f = 0; f < fiber_lines.size(); ++f)
      {
        const Line        &line  = fiber_lines[f];
        const unsigned int last  = line.first_node + line.n_nodes() - 1;
        const unsigned int along = direction(fibers.tows[line.tow]);
        with_ends->ends[along]   = {{line.first_node, last}};
        for (unsigned int n = line.first_node; n < last; ++n)
          original_nodes.push_back({n, {{0, 0}}});
        original_nodes.push_back({line.first_node, {{0, 0}}});
        original_nodes.back().periods[along] = 1;
        for (const unsigned int image :
             {f, f + with_ends->images.n_originals()})
          with_ends->mesh.fiber_lines[image].period = line.n_elements;
      }
    seen = with_ends;
  }



  const FiberImages *
  FiberMesh::images() const
  {
    return seen ? &seen->images : nullptr;
  }



  const FiberMesh &
  FiberMesh::with_images() const
  {
    return seen ? seen->mesh : *this;
  }



  DofVector
  FiberMesh::with_images(const DofVector &q) const
  {
    if (!seen)
      return q;
    std::array<Vector3, 2> period;
    for (unsigned int d = 0; d < 2; ++d)
      period[d] =
        q.segment<3>(9 * seen->ends[d][1]) - q.segment<3>(9 * seen->ends[d][0]);
    DofVector all(9 * seen->images.nodes.size());
    for (unsigned int n = 0; n < seen->images.nodes.size(); ++n)
      {
        const NodeImage &image = seen->images.nodes[n];
        all.segment<9>(9 * n)  = q.segment<9>(9 * image.node);
        all.segment<3>(9 * n) +=
          image.periods[0] * period[0] + image.periods[1] * period[1];
      }
    return all;
  }



  double
  FiberMesh::distance(const unsigned int fiber,
                      const double       u,
                      const double       v) const
  {
    const unsigned int period = fiber_lines[fiber].period;
    return std::abs(period > 0 ? std::remainder(u - v, period) : u - v);
  }



  bool
  FiberMesh::is_folded(const DofVector &q, const FiberHistory &history) const
  {
    for (unsigned int e = 0; e < n_elements(); ++e)
      if (beam_elements[e].is_folded(element_dofs(q, e)) &&
          !history.is_broken(e))
        return true;
    return false;
  }



  double
  FiberMesh::largest_section_change(const DofVector &q) const
  {
    double change = 0;
    for (const Line &line : fiber_lines)
      for (unsigned int n = line.first_node;
           n < line.first_node + line.n_nodes();
           ++n)
        {
          // By the largest and the smallest stretch, roots of the eigenvalues
          // of the vectors' products.
          const auto   g1   = q.segment<3>(9 * n + 3) / line.radius;
          const auto   g2   = q.segment<3>(9 * n + 6) / line.radius;
          const double mean = .5 * (g1.squaredNorm() + g2.squaredNorm());
          const double distance =
            std::hypot(.5 * (g1.squaredNorm() - g2.squaredNorm()), g1.dot(g2));
          for (const double squared : {mean - distance, mean + distance})
            change =
              std::max(change, std::abs(std::sqrt(std::max(squared, 0.)) - 1));
        }
    return change;
  }



  ElementPoint
  FiberMesh::locate(const unsigned int fiber, const double u) const
  {
    const Line  &line = fiber_lines[fiber];
    const double e =
      std::clamp(std::floor(u), 0., static_cast<double>(line.n_elements - 1));
    return {line.first_element + static_cast<unsigned int>(e),
            std::clamp(2 * (u - e) - 1, -1., 1.)};
  }



  Section
  FiberMesh::section(const DofVector &q, const ElementPoint &point) const
  {
    const auto   N     = shape_values(point.xi);
    const auto   dN    = shape_derivatives(point.xi);
    const double scale = 2; // d xi / d u

    Section section{Vector3::Zero(),
                    Vector3::Zero(),
                    Vector3::Zero(),
                    Vector3::Zero()};
    for (unsigned int a = 0; a < 3; ++a)
      {
        const auto node = q.segment<9>(9 * (first_node(point.element) + a));
        section.center += N[a] * node.head<3>();
        section.center_derivative += scale * dN[a] * node.head<3>();
        section.vector_1 += N[a] * node.segment<3>(3);
        section.vector_2 += N[a] * node.tail<3>();
      }
    return section;
  }
} // namespace fiberloom
