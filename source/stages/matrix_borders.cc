// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/stages/matrix_borders.h>

#include <algorithm>
#include <array>

namespace fiberloom
{
  namespace MatrixBorders
  {
    namespace
    {
      const std::array<const char *, n_bodies> border_names{
        {"x start", "x end", "y start", "y end"}};

      std::vector<unsigned int>
      nodes(const Scene &scene, const unsigned int border)
      {
        return scene.composite->matrix().border_nodes(
          *MatrixBorder::find(border_names[border]));
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
    add(const Scene &scene, const Grip grip, Supports &supports)
    {
      if (scene.composite == nullptr)
        return;
      std::vector<bool> is_held(scene.composite->matrix().n_nodes(), false);
      for (unsigned int border = 0; border < n_bodies; ++border)
        {
          RigidBody body;
          body.name = "matrix_" + std::string(border_names[border]);
          std::replace(body.name.begin(), body.name.end(), ' ', '_');
          std::bitset<3> held;
          if (grip == Grip::across)
            held.set(border / 2);
          else if (grip == Grip::whole)
            held.set();
          if (held.any())
            for (const unsigned int node : nodes(scene, border))
              if (!is_held[node])
                {
                  supports.attachments.push_back(attach(
                    *scene.composite, node, supports.bodies.size(), held));
                  is_held[node] = true;
                }
          supports.bodies.push_back(body);
        }
    }



    void
    place(const Scene &scene, const unsigned int first, State &state)
    {
      if (scene.composite == nullptr ||
          state.placements.size() == first + n_bodies)
        return;
      state.placements.resize(first);
      const auto positions = scene.composite->positions(state.q);
      for (unsigned int border = 0; border < n_bodies; ++border)
        {
          Placement  placement;
          const auto held = nodes(scene, border);
          for (const unsigned int node : held)
            placement.position +=
              positions.segment<3>(3 * node) / double(held.size());
          state.placements.push_back(placement);
        }
    }
  } // namespace MatrixBorders
} // namespace fiberloom
