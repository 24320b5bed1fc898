// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/coupling/hold.h>

#include <fiberloom/stages/cell.h>

#include <algorithm>
#include <cmath>

namespace fiberloom
{
  namespace Cell
  {
    namespace
    {
      PeriodicCell
      cell_of(const Scene &scene)
      {
        return {body, *scene.fibers.cell};
      }

      /** Of a fiber, the node nearest to the first tow that crosses it: the
       * same particle wherever the cell is cut. */
      unsigned int
      anchor(const Scene &scene, const unsigned int fiber)
      {
        const Tow &tow = scene.fibers.tows[scene.fibers.fibers[fiber].tow];
        const FiberMesh::Line &line   = scene.mesh.lines()[fiber];
        const unsigned int     along  = direction(tow);
        const double           period = (*scene.fibers.cell)[along];
        double                 place  = 0;
        for (const Tow &other : scene.fibers.tows)
          if (other.family != tow.family && other.ply == tow.ply)
            {
              place = other.center;
              break;
            }
        unsigned int nearest = line.first_node;
        double       least   = 1e300;
        for (unsigned int n = line.first_node;
             n + 1 < line.first_node + line.n_nodes();
             ++n)
          if (const double away = std::abs(std::remainder(
                scene.mesh.initial()[9 * n + along] - place, period));
              away < least - 1e-9 * period)
            {
              least   = away;
              nearest = n;
            }
        return nearest;
      }

      /** Fibers that hang on a matrix. */
      std::vector<bool>
      joined_fibers(const Scene &scene)
      {
        std::vector<bool> joined(scene.fibers.fibers.size(), false);
        if (scene.composite == nullptr)
          return joined;
        std::vector<bool> nodes(scene.mesh.n_nodes(), false);
        for (const JunctionElement &junction : scene.composite->junctions())
          nodes[junction.fiber_nodes()[0]] = true;
        for (unsigned int f = 0; f < joined.size(); ++f)
          {
            const auto &line  = scene.mesh.lines()[f];
            const auto  first = nodes.begin() + line.first_node;
            joined[f] = std::find(first, first + line.n_nodes(), true) !=
                        first + line.n_nodes();
          }
        return joined;
      }

      /** The cell as a frame of hinged bars. */
      struct Frame
      {
        double warp, fill; // stretches of the periods
        double angle;      // by which that between them has closed [rad]

        /** Of the period along the warp, as the gradient is symmetric. */
        double
        warp_turn() const
        {
          return std::atan2(fill * std::sin(angle),
                            warp + fill * std::cos(angle));
        }
      };

      Frame
      frame_of(const Scene &scene, const Placement &placement)
      {
        const Matrix3 F = gradient(scene, placement);
        return {F.col(0).norm(),
                F.col(1).norm(),
                std::atan2(F(1, 0), F(0, 0)) + std::atan2(F(0, 1), F(1, 1))};
      }

      double
      mean_period(const Scene &scene)
      {
        const auto &size = *scene.fibers.cell;
        return std::sqrt(size[0] * size[1]);
      }
    } // namespace



    Supports
    supports(const Scene         &scene,
             const std::bitset<3> free,
             const Spacing        spacing,
             const unsigned int   plies_held)
    {
      Supports supports;
      supports.cell = cell_of(scene);
      RigidBody cell;
      cell.name = "cell";
      for (unsigned int k = 0; k < 3; ++k)
        cell.prescribed[k] = !free[k];
      supports.bodies.push_back(cell);

      const std::vector<bool> joined = joined_fibers(scene);
      // Junctions hold what would else be free, but for the whole.
      const unsigned int first =
        std::find(joined.begin(), joined.end(), true) - joined.begin();
      unsigned int n_held = 0; // plies
      for (unsigned int f = 0; f < scene.fibers.fibers.size(); ++f)
        {
          const unsigned int node = anchor(scene, f);
          Attachment         attachment =
            attach(scene.mesh.initial(), node, body, Hold::axial);
          attachment.held.set(4); // nor can it spin
          const Tow &tow = scene.fibers.tows[scene.fibers.fibers[f].tow];
          if (scene.composite != nullptr)
            {
              attachment.held[0] = attachment.held[1] = f == first;
              attachment.held[2] = !joined[f] || f == first;
            }
          else if (spacing == Spacing::held &&
                   f == tow.fibers[tow.fibers.size() / 2])
            attachment.held.set(0);
          if (scene.composite == nullptr && tow.ply == n_held &&
              n_held < plies_held)
            {
              attachment.held.set(1);
              ++n_held;
            }
          const Vector3 x = scene.mesh.initial().segment<3>(9 * node);
          attachment.carried =
            supports.cell->slope(x[0] / supports.cell->size[0],
                                 x[1] / supports.cell->size[1]);
          supports.attachments.push_back(attachment);
        }
      return supports;
    }



    void
    place(State &state)
    {
      state.placements.resize(body + 1);
    }



    std::array<double, 2>
    periods(const Scene &scene, const Placement &placement)
    {
      const Eigen::Matrix2d periods = plane_periods(scene, placement);
      return {{periods.col(0).norm(), periods.col(1).norm()}};
    }



    Placement
    strained(const Scene     &scene,
             const Placement &start,
             const double     warp_strain,
             const double     fill_strain)
    {
      const auto &size  = *scene.fibers.cell;
      Placement   moved = start;
      moved.position[0] += warp_strain * (size[0] + start.position[0]);
      moved.position[1] += fill_strain * (size[1] + start.position[1]);
      return moved;
    }



    Placement
    sheared(const Scene &scene, const Placement &start, const double angle)
    {
      Frame frame = frame_of(scene, start);
      frame.angle += angle;
      const double turn  = frame.warp_turn();
      const auto  &size  = *scene.fibers.cell;
      Placement    moved = start;
      moved.position     = {size[0] * (frame.warp * std::cos(turn) - 1),
                            size[1] *
                              (frame.fill * std::cos(frame.angle - turn) - 1),
                            2 * mean_period(scene) * frame.warp * std::sin(turn)};
      return moved;
    }



    Vector3
    shear_rate(const Scene &scene, const Placement &placement)
    {
      const Frame  frame = frame_of(scene, placement);
      const double turn = frame.warp_turn(), w = frame.warp, f = frame.fill,
                   along = w * f * std::cos(frame.angle),
                   rate  = (f * f + along) / (w * w + f * f + 2 * along);
      const auto &size   = *scene.fibers.cell;
      return {-size[0] * w * std::sin(turn) * rate,
              -size[1] * f * std::sin(frame.angle - turn) * (1 - rate),
              2 * mean_period(scene) * w * std::cos(turn) * rate};
    }



    Matrix3
    gradient(const Scene &scene, const Placement &placement)
    {
      const PeriodicCell cell = cell_of(scene);
      const auto         edge = [&](const double x, const double y) -> Vector3 {
        return (cell.shift(x, y) + cell.slope(x, y) * placement.position) /
               cell.shift(x, y).norm();
      };
      Matrix3 F;
      F << edge(1, 0), edge(0, 1), Vector3::UnitZ();
      return F;
    }



    Eigen::Matrix2d
    plane_periods(const Scene &scene, const Placement &placement)
    {
      const auto &size = *scene.fibers.cell;
      return gradient(scene, placement).topLeftCorner<2, 2>() *
             Eigen::Vector2d(size[0], size[1]).asDiagonal();
    }



    double
    area(const Scene &scene, const Placement &placement)
    {
      return plane_periods(scene, placement).determinant();
    }



    double
    pull(const Tow::Family family, const std::vector<BodyVector> &reactions)
    {
      return reactions[body][family == Tow::Family::warp ? 0 : 1];
    }



    CurveRow
    curve(const Scene                   &scene,
          const State                   &state,
          const std::vector<BodyVector> &reactions)
    {
      const double mean    = mean_period(scene);
      const auto   start   = periods(scene, state.stage_start_placements[body]),
                 now       = periods(scene, state.placements[body]);
      constexpr auto width = Quantity::force_per_width;
      constexpr auto warp = Tow::Family::warp, fill = Tow::Family::fill;
      return {{{"force_per_width_warp", width, Role::detail, warp},
               reactions[body][0] / start[1]},
              {{"force_per_width_fill", width, Role::detail, fill},
               reactions[body][1] / start[0]},
              {{"force_per_width_shear", width}, reactions[body][2] / mean},
              {{"period_warp", Quantity::length, Role::detail, warp}, now[0]},
              {{"period_fill", Quantity::length, Role::detail, fill}, now[1]},
              {{"shear_strain", Quantity::strain},
               state.placements[body].position[2] / mean}};
    }
  } // namespace Cell
} // namespace fiberloom
