// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/parameter_catalogue.h>
#include <fiberloom/base/parameters.h>

#include <fiberloom/stages/bend.h>

#include <boost/math/special_functions/sinc.hpp>

#include <cmath>

namespace fiberloom
{
  namespace
  {
    /** About which the border at the end turns, so that the middle rises. */
    Vector3
    turning_axis(const unsigned int axis)
    {
      return axis == 0 ? Vector3(Vector3::UnitY()) : Vector3(-Vector3::UnitX());
    }
  } // namespace



  void
  BendSettings::declare(ParameterCatalogue &catalogue)
  {
    catalogue.enter_section("Bending");
    catalogue.add("Direction",
                  direction,
                  "Family of tows that is bent: its two borders turn against "
                  "each other.");
    angle.declare(catalogue);
    catalogue.leave_section();
  }



  void
  BendSettings::check(const Parameters &parameters) const
  {
    Way::check(angle.way, parameters.where("Bending/Way"));
  }



  StageType
  Bend::type()
  {
    return {"bend",
            "turns two borders against each other",
            StageType::Sample::fabric_with_ends,
            &make<Bend>,
            &make_settings<BendSettings>};
  }



  Bend::Bend(const Scene &scene)
    : AngleTest(scene,
                scene.parameters.stage_settings.get<BendSettings>().angle)
    , axis(scene.parameters.stage_settings.get<BendSettings>().direction ==
               Direction::warp ?
             0 :
             1)
  {
    const Extent extent = skin_extent(scene.mesh, scene.mesh.initial());
    length              = extent.high[axis] - extent.low[axis];
  }



  Supports
  Bend::supports(const DofVector &) const
  {
    Supports supports = TowEnds::supports(scene, 0, MatrixBorders::Grip::whole);
    // What a free body holds stays together, but goes where it likes; on the
    // matrix it would be a frame.
    const unsigned int n_tow_ends = 2 * scene.fibers.tows.size();
    for (unsigned int b = 0; b < n_tow_ends; ++b)
      if (!is_bent(b))
        supports.bodies[b].prescribed.reset();
    std::vector<Attachment> kept;
    for (const Attachment &attachment : supports.attachments)
      if (attachment.body < n_tow_ends || is_bent(attachment.body))
        kept.push_back(attachment);
    supports.attachments = std::move(kept);
    if (!scene.composite)
      hold_without_matrix(supports.bodies);
    return supports;
  }



  void
  Bend::hold_without_matrix(std::vector<RigidBody> &bodies) const
  {
    for (unsigned int b = 0; b < bodies.size(); ++b)
      if (is_bent(b))
        {
          if (border(b) % 2 == 1)
            bodies[b].prescribed.reset(axis);
        }
      else
        for (const unsigned int held : {1 - axis, 3 + axis, 5u})
          bodies[b].prescribed.set(held);
  }



  Vector3
  Bend::border_center(const std::vector<Placement> &placements,
                      const unsigned int            side) const
  {
    Vector3      sum = Vector3::Zero();
    unsigned int n   = 0;
    for (unsigned int b = 0; b < 2 * scene.fibers.tows.size(); ++b)
      if (is_bent(b) && b % 2 == side)
        {
          sum += placements[b].position;
          ++n;
        }
    return sum / n;
  }



  Placement
  Bend::move(const std::vector<Placement> &start,
             const unsigned int            body,
             const double                  angle) const
  {
    if (!is_bent(body))
      return start[body];
    const unsigned int side = border(body) % 2;
    const double       sign = side == 0 ? -1 : 1;
    const Vector3      here = border_center(start, side),
                  other     = border_center(start, 1 - side);
    const double half       = .5 * angle;
    // Half the chord of an arc over its half length.
    const double            shortening = boost::math::sinc_pi(half);
    const Vector3           middle     = .5 * (here + other);
    const Eigen::AngleAxisd turn(sign * half, turning_axis(axis));

    Placement moved = start[body];
    moved.position  = middle + shortening * (here - middle) +
                     turn * (start[body].position - here);
    moved.rotation = turn * start[body].rotation;
    return moved;
  }



  Vector3
  Bend::place(const std::vector<Placement> &,
              const Vector3 &start,
              const double   angle) const
  {
    using boost::math::sinc_pi;
    const double along = start[axis], curvature = angle / length,
                 before = .5 * length + along, behind = .5 * length - along,
                 turn = curvature * along;
    Vector3 place     = start;
    place[axis]       = along * sinc_pi(turn) + start.z() * std::sin(turn);
    place.z() =
      start.z() * std::cos(turn) + .5 * curvature * before * behind *
                                     sinc_pi(.5 * curvature * before) *
                                     sinc_pi(.5 * curvature * behind);
    return place;
  }



  Vector3
  Bend::spin(const Vector3 &start, const Direction) const
  {
    return start[axis] / length * turning_axis(axis);
  }



  CurveRow
  Bend::curve(const State                   &state,
              const std::vector<BodyVector> &reactions) const
  {
    double moment = 0, force = 0;
    for (unsigned int b = 0; b < reactions.size(); ++b)
      if (is_bent(b))
        {
          const unsigned int side  = border(b) % 2;
          const double       sign  = side == 0 ? -1 : 1;
          const Vector3      lever = state.placements[b].position -
                                border_center(state.placements, side);
          moment += .5 * sign *
                    turning_axis(axis).dot(reactions[b].tail<3>() +
                                           lever.cross(reactions[b].head<3>()));
          force += .5 * sign * reactions[b][axis];
        }
    return {{{"bending_angle", Quantity::angle, Role::deformation},
             angle_at(state.load)},
            {{"bending_moment", Quantity::moment, Role::response}, moment},
            {{"axial_force", Quantity::force}, force}};
  }
} // namespace fiberloom
