// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/parameter_catalogue.h>
#include <fiberloom/base/parameters.h>

#include <fiberloom/stages/cell.h>
#include <fiberloom/stages/shear.h>

#include <cmath>
#include <limits>

namespace fiberloom
{
  namespace
  {
    /** Of a border or what runs along it; half the angle towards the other. */
    double
    half_turn(const Direction along)
    {
      return along == Direction::warp ? .5 : -.5;
    }

    /** Of a shear @p angle [rad] and what it takes, [N] and [N mm]. */
    CurveRow
    curve_row(const double angle, const double force, const double moment)
    {
      return {{{"shear_angle", Quantity::angle, Role::deformation}, angle},
              {{"shear_force", Quantity::force, Role::response}, force},
              {{"shear_moment", Quantity::moment}, moment}};
    }
  } // namespace



  void
  ShearSettings::declare(ParameterCatalogue &catalogue)
  {
    catalogue.enter_section("Shear");
    angle.declare(catalogue);
    catalogue.leave_section();
  }



  void
  ShearSettings::check(const Parameters &parameters) const
  {
    Way::check(angle.way, parameters.where("Shear/Way"));
  }



  StageType
  Shear::type()
  {
    return {"shear",
            "makes a frame of the borders and tilts it",
            StageType::Sample::fabric,
            &make<Shear>,
            &make_settings<ShearSettings>};
  }



  Shear::Shear(const Scene &scene)
    : AngleTest(scene,
                scene.parameters.stage_settings.get<ShearSettings>().angle)
  {}



  Supports
  Shear::supports(const DofVector &) const
  {
    return scene.fibers.cell ?
             Cell::supports(scene, 0) :
             TowEnds::supports(scene, 0, MatrixBorders::Grip::whole);
  }



  Placement
  Shear::move(const std::vector<Placement> &start,
              const unsigned int            body,
              const double                  angle) const
  {
    if (scene.fibers.cell)
      return Cell::sheared(scene, start[body], angle);
    Placement moved = start[body];
    moved.position  = place(start, start[body].position, angle);
    moved.rotation =
      Eigen::AngleAxisd(angle * half_turn(runs_along(body)), Vector3::UnitZ()) *
      start[body].rotation;
    return moved;
  }



  Vector3
  Shear::place(const std::vector<Placement> &begun,
               const Vector3                &start,
               const double                  angle) const
  {
    if (scene.fibers.cell)
      {
        const Placement &at = begun[Cell::body];
        return Cell::gradient(scene, Cell::sheared(scene, at, angle)) *
               Cell::gradient(scene, at).inverse() * start;
      }
    const double c = std::cos(.5 * angle), s = std::sin(.5 * angle);
    return {c * start.x() + s * start.y(),
            s * start.x() + c * start.y(),
            start.z()};
  }



  Vector3
  Shear::spin(const Vector3 &, const Direction along) const
  {
    return half_turn(along) * Vector3::UnitZ();
  }



  CurveRow
  Shear::curve(const State                   &state,
               const std::vector<BodyVector> &reactions) const
  {
    if (scene.fibers.cell)
      return cell_curve(state, reactions);
    // Of the bars of the frame, by the power of all bodies.
    const double c = std::cos(.5 * angle_at(state.load)),
                 s = std::sin(.5 * angle_at(state.load));

    constexpr double infinity = std::numeric_limits<double>::infinity();
    double           moment = 0, left = infinity, right = -infinity;
    for (unsigned int b = 0; b < reactions.size(); ++b)
      if (border(b) < 4)
        {
          const Vector3 from = state.stage_start_placements[b].position;
          moment += .5 * (reactions[b][0] * (c * from.y() - s * from.x()) +
                          reactions[b][1] * (c * from.x() - s * from.y())) +
                    half_turn(runs_along(b)) * reactions[b][5];
          left  = std::min(left, from.x());
          right = std::max(right, from.x());
        }
    return curve_row(angle_at(state.load), moment / (right - left), moment);
  }



  CurveRow
  Shear::cell_curve(const State                   &state,
                    const std::vector<BodyVector> &reactions) const
  {
    const Placement &placement = state.placements[Cell::body];
    const double     moment =
      reactions[Cell::body].head<3>().dot(Cell::shear_rate(scene, placement));
    return curve_row(angle_at(state.load),
                     moment / Cell::periods(scene, placement)[0],
                     moment);
  }
} // namespace fiberloom
