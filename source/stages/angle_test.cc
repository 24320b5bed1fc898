// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/parameter_catalogue.h>
#include <fiberloom/base/parameters.h>

#include <fiberloom/stages/angle_test.h>
#include <fiberloom/stages/cell.h>
#include <fiberloom/stages/matrix_borders.h>

namespace fiberloom
{
  namespace
  {
    // A first guess goes back in time by this part of the test.
    constexpr double guess_step = 1e-4;
  } // namespace



  void
  AngleSettings::declare(ParameterCatalogue &catalogue)
  {
    catalogue.add("Largest angle",
                  largest_angle,
                  "Angle at the end of the test, or where Way is 1 [rad].",
                  Allowed::from_to(1e-9, 3));
    catalogue.add("First step",
                  first_step,
                  "First increment of the angle, and of each leg of Way [rad]; "
                  "never more than the largest step.",
                  Allowed::from_to(1e-9, 1));
    catalogue.add("Largest step",
                  largest_step,
                  "Largest increment of the angle [rad].",
                  Allowed::from_to(1e-9, .26));
    Way::declare(catalogue, way, "the largest angle", -1);
  }



  AngleTest::AngleTest(const Scene &scene, const AngleSettings &angles)
    : Stage(scene)
    , angles(angles)
    , turning(angles.way)
  {}



  unsigned int
  AngleTest::border(const unsigned int body) const
  {
    const auto        &tows   = scene.fibers.tows;
    const unsigned int ground = 2 * tows.size();
    if (body < ground)
      return (tows[body / 2].family == Tow::Family::warp ? 0 : 2) + body % 2;
    return body == ground ? 4 : body - ground - 1;
  }



  Direction
  AngleTest::runs_along(const unsigned int body) const
  {
    const bool on_matrix = body > 2 * scene.fibers.tows.size();
    return (border(body) < 2) != on_matrix ? Direction::warp : Direction::fill;
  }



  void
  AngleTest::begin(State &state) const
  {
    TowEnds::place(scene, MatrixBorders::Grip::whole, state);
  }



  Past
  AngleTest::guess(const State &state, const double load_step) const
  {
    // A short while ago: what bodies hold hardly turns with them then.
    const double from         = angle_at(state.load),
                 step         = angle_at(state.load + load_step) - from,
                 part         = guess_step / load_step;
    const DofVector &start    = state.stage_start_q;
    const auto       has_gone = [&](const auto &position) -> Vector3 {
      return part *
             (place(state.stage_start_placements, position, from + step) -
              place(state.stage_start_placements, position, from));
    };
    Past past{state.q, state.placements, state.load - guess_step};
    for (const auto &line : scene.mesh.lines())
      {
        const Direction along =
          scene.fibers.tows[line.tow].family == Tow::Family::warp ?
            Direction::warp :
            Direction::fill;
        for (unsigned int n = line.first_node;
             n < line.first_node + line.n_nodes();
             ++n)
          {
            const Vector3 began = start.segment<3>(9 * n);
            const Vector3 spins = step * spin(began, along);
            const Matrix3 turn =
              Eigen::AngleAxisd(spins.norm(), spins.stableNormalized())
                .toRotationMatrix() -
              Matrix3::Identity();
            auto node = past.q.segment<9>(9 * n);
            node.head<3>() -= has_gone(began);
            for (const unsigned int v : {3, 6})
              node.segment<3>(v) -= part * turn * node.segment<3>(v);
          }
      }
    for (Eigen::Index i = 9 * scene.mesh.n_nodes(); i < past.q.size(); i += 3)
      past.q.segment<3>(i) -= has_gone(start.segment<3>(i));
    if (scene.fibers.cell)
      {
        const auto &begun = state.stage_start_placements;
        past.placements[Cell::body].position -=
          part * (move(begun, Cell::body, from + step).position -
                  move(begun, Cell::body, from).position);
        return past;
      }
    for (unsigned int b = 0; b < past.placements.size(); ++b)
      {
        const Vector3 began     = state.stage_start_placements[b].position;
        Placement    &placement = past.placements[b];
        placement.turn -= part * step * spin(began, runs_along(b));
        placement.position -= has_gone(began);
      }
    return past;
  }



  std::vector<BodyTarget>
  AngleTest::targets(const std::vector<Placement> &start,
                     const double                  load) const
  {
    std::vector<BodyTarget> targets(start.size());
    for (unsigned int b = 0; b < start.size(); ++b)
      targets[b].placement = border(b) < MatrixBorders::n_bodies ?
                               move(start, b, angle_at(load)) :
                               start[b];
    return targets;
  }
} // namespace fiberloom
