// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/coupling/hold.h>

#include <fiberloom/stages/cell.h>
#include <fiberloom/stages/matrix_borders.h>
#include <fiberloom/stages/tow_ends.h>

#include <cmath>

namespace fiberloom
{
  namespace TowEnds
  {
    namespace
    {
      unsigned int
      end_node(const FiberMesh   &mesh,
               const unsigned int fiber,
               const unsigned int side)
      {
        const auto &line = mesh.lines()[fiber];
        return line.first_node + (side == 0 ? 0 : line.n_nodes() - 1);
      }

      /** Of one layer, an end could turn about the line of its centres without
       * any resistance. */
      bool
      has_layers(const FiberMesh &mesh, const Tow &tow)
      {
        const auto height = [&](const unsigned int fiber) {
          return mesh.initial()[9 * end_node(mesh, fiber, 0) + 2];
        };
        for (const unsigned int fiber : tow.fibers)
          if (std::abs(height(fiber) - height(tow.fibers[0])) >
              mesh.lines()[fiber].radius)
            return true;
        return false;
      }

      std::string
      family_name(const Tow &tow)
      {
        return tow.family == Tow::Family::warp ? "warp" : "fill";
      }
    } // namespace



    Vector3
    axis(const Tow &tow)
    {
      return tow.family == Tow::Family::warp ? Vector3::UnitX() :
                                               Vector3::UnitY();
    }



    Supports
    supports(const Scene              &scene,
             const std::bitset<2>      free,
             const MatrixBorders::Grip grip)
    {
      if (scene.fibers.cell)
        return Cell::supports(scene,
                              free.to_ulong(),
                              free.all() ? Cell::Spacing::held :
                                           Cell::Spacing::free);
      const auto &tows = scene.fibers.tows;
      Supports    supports;
      for (const Tow &tow : tows)
        for (unsigned int side = 0; side < 2; ++side)
          {
            RigidBody body;
            body.name = family_name(tow) + "_" + std::to_string(tow.number) +
                        (side == 0 ? "_start" : "_end");
            const unsigned int along = direction(tow);
            if (free[along])
              body.prescribed[along] = false;
            if (free[along] && has_layers(scene.mesh, tow))
              body.prescribed[4 - along] = false; // slopes with the tow
            for (const unsigned int fiber : tow.fibers)
              supports.attachments.push_back(
                attach(scene.mesh.initial(),
                       end_node(scene.mesh, fiber, side),
                       supports.bodies.size(),
                       Hold::direction));
            supports.bodies.push_back(body);
          }

      RigidBody ground;
      ground.name = "ground";
      for (const Tow &tow : tows)
        if (free[direction(tow)])
          for (const unsigned int fiber : tow.fibers)
            {
              const auto &line = scene.mesh.lines()[fiber];
              supports.attachments.push_back(
                attach(scene.mesh.initial(),
                       line.first_node + line.n_elements,
                       supports.bodies.size(),
                       Hold::axial));
            }
      supports.bodies.push_back(ground);
      MatrixBorders::add(scene,
                         free.all() ? MatrixBorders::Grip::none : grip,
                         free,
                         supports);
      return supports;
    }



    void
    place(const Scene &scene, const MatrixBorders::Grip grip, State &state)
    {
      if (scene.fibers.cell)
        return Cell::place(state);
      const auto &tows = scene.fibers.tows;
      const bool  after_others =
        !state.stages_done.empty() &&
        is_stage(state.stages_done.back(), &StageType::moves_own_bodies);
      const unsigned int n = 2 * tows.size() + 1;
      if (state.placements.size() >= n && !after_others)
        return MatrixBorders::place(scene, n, grip, state);
      state.placements.assign(n, Placement());
      for (unsigned int t = 0; t < tows.size(); ++t)
        for (unsigned int side = 0; side < 2; ++side)
          {
            Vector3 mean = Vector3::Zero();
            for (const unsigned int fiber : tows[t].fibers)
              mean += state.q.segment<3>(9 * end_node(scene.mesh, fiber, side));
            state.placements[body(t, side)].position =
              mean / tows[t].fibers.size();
          }
      MatrixBorders::place(scene, n, grip, state);
    }



    double
    pull(const Scene                   &scene,
         const Tow::Family              family,
         const std::vector<BodyVector> &reactions)
    {
      if (scene.fibers.cell)
        return Cell::pull(family, reactions);
      double pull = 0;
      for (unsigned int t = 0; t < scene.fibers.tows.size(); ++t)
        if (scene.fibers.tows[t].family == family)
          pull += .5 * axis(scene.fibers.tows[t])
                         .dot(reactions[body(t, 1)].head<3>() -
                              reactions[body(t, 0)].head<3>());
      return pull + MatrixBorders::pull(2 * scene.fibers.tows.size() + 1,
                                        family == Tow::Family::warp ? 0 : 1,
                                        reactions);
    }
  } // namespace TowEnds
} // namespace fiberloom
