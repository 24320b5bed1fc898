// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/choices.h>

#include <fiberloom/stages/matrix_borders.h>

#include <algorithm>

namespace fiberloom
{
  namespace MatrixBorders
  {
    namespace
    {
      /** The borders that each node of the matrix is on, a bit for each. */
      std::vector<unsigned int>
      borders(const MatrixMesh &matrix)
      {
        std::vector<unsigned int> borders(matrix.n_nodes(), 0);
        for (unsigned int b = 0; b < n_bodies; ++b)
          for (const unsigned int node :
               matrix.border_nodes(static_cast<MatrixBorder>(b)))
            borders[node] |= 1 << b;
        return borders;
      }

      /** The borders of a body's nodes. */
      unsigned int
      borders_of_body(const unsigned int body)
      {
        if (body < n_bodies)
          return 1 << body;
        const unsigned int edge = body - n_bodies;
        return 1 << edge / 2 | 1 << (2 + edge % 2);
      }

      unsigned int
      number_of_bodies(const Grip grip)
      {
        return n_bodies + (grip == Grip::across ? n_edges : 0);
      }

      /** That of an edge where there is one, else the first border's. */
      unsigned int
      body_of_node(const unsigned int borders, const Grip grip)
      {
        for (unsigned int body = n_bodies; body < number_of_bodies(grip);
             ++body)
          if (borders_of_body(body) == borders)
            return body;
        unsigned int body = 0;
        while ((borders_of_body(body) & borders) == 0)
          ++body;
        return body;
      }

      std::string
      name(const unsigned int body)
      {
        std::string name = "matrix";
        for (unsigned int b = 0; b < n_bodies; ++b)
          if (borders_of_body(body) >> b & 1)
            name += "_" + name_of(static_cast<MatrixBorder>(b));
        std::replace(name.begin(), name.end(), ' ', '_');
        return name;
      }
    } // namespace



    Attachment
    attach(const Composite     &composite,
           const unsigned int   matrix_node,
           const unsigned int   body,
           const std::bitset<3> held)
    {
      Attachment attachment;
      attachment.node = composite.first_node() + matrix_node;
      attachment.body = body;
      for (unsigned int c = 0; c < 3; ++c)
        attachment.held[c] = held[c];
      return attachment;
    }



    void
    add(const Scene         &scene,
        const Grip           grip,
        const std::bitset<2> free,
        Supports            &supports)
    {
      if (scene.composite == nullptr)
        return;
      const unsigned int first = supports.bodies.size();
      for (unsigned int body = 0; body < number_of_bodies(grip); ++body)
        {
          supports.bodies.emplace_back();
          supports.bodies.back().name = name(body);
        }
      if (grip == Grip::none)
        return;
      for (unsigned int body = 0; body < number_of_bodies(grip); ++body)
        for (unsigned int axis = 0; axis < 2; ++axis)
          if (free[axis] && (borders_of_body(body) >> 2 * axis & 3) != 0)
            supports.bodies[first + body].prescribed[axis] = false;
      const auto borders_of_node = borders(scene.composite->matrix());
      for (unsigned int node = 0; node < borders_of_node.size(); ++node)
        if (const unsigned int on = borders_of_node[node]; on != 0)
          {
            std::bitset<3> held;
            held[0] = grip == Grip::whole || on & 3;
            held[1] = grip == Grip::whole || on >> 2;
            held[2] = grip == Grip::whole;
            supports.attachments.push_back(attach(
              *scene.composite, node, first + body_of_node(on, grip), held));
          }
    }



    void
    place(const Scene       &scene,
          const unsigned int first,
          const Grip         grip,
          State             &state)
    {
      if (scene.composite == nullptr ||
          state.placements.size() == first + number_of_bodies(grip))
        return;
      state.placements.resize(first);
      const auto positions       = scene.composite->positions(state.q);
      const auto borders_of_node = borders(scene.composite->matrix());
      for (unsigned int body = 0; body < n_bodies; ++body)
        {
          Vector3      sum     = Vector3::Zero();
          unsigned int n_nodes = 0;
          for (unsigned int node = 0; node < borders_of_node.size(); ++node)
            if (borders_of_node[node] >> body & 1)
              {
                sum += positions.segment<3>(3 * node);
                ++n_nodes;
              }
          state.placements.emplace_back();
          state.placements.back().position = sum / n_nodes;
        }
      // An edge goes with each of its borders across that one.
      for (unsigned int edge = 0; edge < number_of_bodies(grip) - n_bodies;
           ++edge)
        {
          Placement placement = state.placements[first + edge / 2];
          placement.position.y() =
            state.placements[first + 2 + edge % 2].position.y();
          state.placements.push_back(placement);
        }
    }



    double
    pull(const unsigned int             first,
         const unsigned int             axis,
         const std::vector<BodyVector> &reactions)
    {
      double pull = 0;
      for (unsigned int body = 0; first + body < reactions.size(); ++body)
        for (unsigned int side = 0; side < 2; ++side)
          if (borders_of_body(body) >> (2 * axis + side) & 1)
            pull += (side == 0 ? -.5 : .5) * reactions[first + body][axis];
      return pull;
    }
  } // namespace MatrixBorders
} // namespace fiberloom
