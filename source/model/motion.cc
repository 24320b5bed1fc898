// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/model/held_nodes.h>
#include <fiberloom/model/motion.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace fiberloom
{
  namespace
  {
    using Matrix2 = Eigen::Matrix2d;
    using Vectors = Eigen::Matrix<double, 3, 2>;

    /** Section vectors that turn and are stretched by @p change , each to first
     * order alike: a straight change would stretch what it turns, to second
     * order, and sections are stiff. */
    Vectors
    turned(const Vectors &section, const Vectors &change)
    {
      using Spectrum         = Eigen::SelfAdjointEigenSolver<Matrix2>;
      const Vectors straight = section + change;
      const Matrix2 stretch =
        Spectrum(section.transpose() * section).operatorSqrt();
      const Matrix2 twice =
        section.transpose() * change + change.transpose() * section;
      const double trace = stretch.trace(), determinant = stretch.determinant();
      const Matrix2 adjoint = trace * Matrix2::Identity() - stretch;
      // U X + X U = E, in the plane.
      const Matrix2 stretched =
        stretch + (determinant * twice + adjoint * twice * adjoint) /
                    (2 * trace * determinant);
      const Vectors result =
        straight *
        Spectrum(straight.transpose() * straight).operatorInverseSqrt() *
        stretched;
      return result.allFinite() ? result : straight;
    }
    constexpr double least_turn = 1e-14; // what rounding leaves of a rotation
  }                                      // namespace



  Motion::Motion(const FiberMesh              &mesh,
                 const Supports               &supports,
                 const BlockLayout            &layout,
                 const std::vector<NodeImage> &originals)
    : mesh(mesh)
    , supports(supports)
    , layout(layout)
    , originals(originals)
    , node_attachments(layout.n_nodes(), -1)
    , fixed(layout.n_dofs(), false)
    , blocks_with_fixed(layout.n_blocks(), false)
  {
    for (unsigned int i = 0; i < supports.attachments.size(); ++i)
      {
        const Attachment &attachment      = supports.attachments[i];
        node_attachments[attachment.node] = i;
        for (unsigned int k = 0; k < layout.size(attachment.node); ++k)
          if (attachment.held[k])
            fixed[layout.first_dof(attachment.node) + k] = true;
        blocks_with_fixed[attachment.node] = attachment.held.any();
      }
    for (unsigned int b = 0; b < supports.bodies.size(); ++b)
      {
        const unsigned int block = layout.body_block(b);
        for (unsigned int k = 0; k < 6; ++k)
          if (supports.bodies[b].prescribed[k])
            fixed[layout.first_dof(block) + k] = true;
        blocks_with_fixed[block] = supports.bodies[b].prescribed.any();
      }
    for (unsigned int n = 0; n < originals.size(); ++n)
      if (is_image(n))
        {
          blocks_with_fixed[n] = true;
          for (unsigned int k = 0; k < layout.size(n); ++k)
            fixed[layout.first_dof(n) + k] = true;
        }
  }



  NodeVector
  Motion::node_dofs(const Eigen::VectorXd &dofs, const unsigned int node) const
  {
    NodeVector values = NodeVector::Zero();
    values.head(layout.size(node)) =
      dofs.segment(layout.first_dof(node), layout.size(node));
    return values;
  }



  std::vector<double>
  Motion::prescribed_increments(const State   &state,
                                const Targets &targets) const
  {
    std::vector<double> increments(layout.n_dofs(), 0.);
    for (unsigned int b = 0; b < targets.bodies.size(); ++b)
      {
        const Placement        &now    = state.placements[b];
        const Placement        &target = targets.bodies[b].placement;
        const Eigen::AngleAxisd turn(target.rotation *
                                     now.rotation.conjugate());
        BodyVector              change;
        change << target.position - now.position, turn.angle() * turn.axis();
        if (turn.angle() < least_turn)
          change.tail<3>().setZero();
        const unsigned int first = layout.first_dof(layout.body_block(b));
        for (unsigned int k = 0; k < 6; ++k)
          if (fixed[first + k])
            increments[first + k] = change[k];
      }
    return increments;
  }



  bool
  Motion::moves(const State &state, const Targets &targets) const
  {
    const double tolerance = 1e-9 * mesh.smallest_radius();
    for (const double value : prescribed_increments(state, targets))
      if (std::abs(value) > tolerance)
        return true;
    return false;
  }



  std::vector<double>
  Motion::largest_moves(const Eigen::VectorXd &increment) const
  {
    std::vector<double> moves;
    for (const auto &line : mesh.lines())
      {
        double move = 0;
        for (unsigned int n = line.first_node;
             n < line.first_node + line.n_nodes();
             ++n)
          for (unsigned int v = 0; v < 3; ++v)
            move = std::max(move,
                            increment.segment<3>(9 * n + 3 * v).norm() /
                              line.radius);
        moves.push_back(move);
      }
    return moves;
  }



  double
  Motion::largest_move(const Eigen::VectorXd &increment) const
  {
    const std::vector<double> moves = largest_moves(increment);
    double move = *std::max_element(moves.begin(), moves.end());
    if (supports.cell && increment.size() == layout.n_dofs())
      for (unsigned int b = 0; b < supports.bodies.size(); ++b)
        move = std::max(
          move,
          increment.segment<3>(layout.first_dof(layout.body_block(b))).norm() /
            mesh.smallest_radius());
    return move;
  }



  double
  Motion::largest_prescribed_move(const State   &state,
                                  const Targets &targets) const
  {
    const std::vector<double> prescribed =
      prescribed_increments(state, targets);
    State moved;
    moved.q          = state.q;
    moved.placements = state.placements;
    advance(moved,
            Eigen::Map<const Eigen::VectorXd>(prescribed.data(),
                                              prescribed.size()),
            1);
    Eigen::VectorXd change      = Eigen::VectorXd::Zero(layout.n_dofs());
    change.head(state.q.size()) = moved.q - state.q;
    for (unsigned int b = 0; b < state.placements.size(); ++b)
      change.segment<3>(layout.first_dof(layout.body_block(b))) =
        moved.placements[b].position - state.placements[b].position;
    return largest_move(change);
  }



  void
  Motion::advance(State                 &state,
                  const Eigen::VectorXd &increment,
                  const double           factor) const
  {
    std::vector<Placement> moved = state.placements;
    for (unsigned int b = 0; b < moved.size(); ++b)
      {
        const BodyVector change =
          factor * increment.segment<6>(layout.first_dof(layout.body_block(b)));
        moved[b].position += change.head<3>();
        moved[b].turn += change.tail<3>();
        const double angle = change.tail<3>().norm();
        if (angle > 0)
          moved[b].rotation =
            (Eigen::Quaterniond(
               Eigen::AngleAxisd(angle, change.tail<3>() / angle)) *
             moved[b].rotation)
              .normalized();
      }

    for (unsigned int n = 0; n < layout.n_nodes(); ++n)
      {
        const unsigned int first = layout.first_dof(n), size = layout.size(n);
        auto               node = state.q.segment(first, size);
        if (const int i = node_attachments[n]; i >= 0)
          node = move_held_node(supports.attachments[i],
                                state.placements[supports.attachments[i].body],
                                moved[supports.attachments[i].body],
                                node_dofs(state.q, n),
                                factor * node_dofs(increment, n))
                   .head(size);
        else
          {
            if (n < mesh.n_nodes())
              {
                Eigen::Map<Vectors> section(node.data() + 3);
                section = turned(section,
                                 factor * Eigen::Map<const Vectors>(
                                            increment.data() + first + 3));
              }
            const unsigned int centered = std::min(size, 3u);
            node.head(centered) += factor * increment.segment(first, centered);
          }
      }
    state.placements = std::move(moved);
    place_images(state);
  }



  void
  Motion::place_images(State &state) const
  {
    if (!supports.cell)
      return;
    const PeriodicCell &cell       = *supports.cell;
    const Vector3       elongation = state.placements[cell.body].position;
    for (unsigned int n = 0; n < originals.size(); ++n)
      if (is_image(n))
        {
          const NodeImage &image   = originals[n];
          const auto [x, y]        = image.periods;
          const unsigned int first = layout.first_dof(n);
          state.q.segment(first, layout.size(n)) =
            state.q.segment(layout.first_dof(image.node), layout.size(n));
          state.q.segment<3>(first) +=
            cell.shift(x, y) + cell.slope(x, y) * elongation;
        }
  }



  void
  Motion::extrapolate(State         &state,
                      const Past    &past,
                      const Targets &targets,
                      const double   load_step) const
  {
    const double    ratio = load_step / (state.load - past.load);
    Eigen::VectorXd increment(layout.n_dofs());

    for (unsigned int n = 0; n < layout.n_nodes(); ++n)
      {
        const NodeVector before = node_dofs(past.q, n),
                         now    = node_dofs(state.q, n);
        NodeVector change       = now - before;
        if (is_image(n))
          change.setZero();
        else if (const int i = node_attachments[n]; i >= 0)
          {
            const Attachment  &held = supports.attachments[i];
            const unsigned int body = held.body;
            change                  = local_change(
              held, past.placements[body], state.placements[body], before, now);
          }
        increment.segment(layout.first_dof(n), layout.size(n)) =
          ratio * change.head(layout.size(n));
      }

    const std::vector<double> prescribed =
      prescribed_increments(state, targets);
    for (unsigned int b = 0; b < state.placements.size(); ++b)
      {
        const Placement &from = past.placements[b], &to = state.placements[b];
        BodyVector       motion;
        motion << to.position - from.position, to.turn - from.turn;
        const unsigned int first = layout.first_dof(layout.body_block(b));
        for (unsigned int k = 0; k < 6; ++k)
          increment[first + k] =
            fixed[first + k] ? prescribed[first + k] : ratio * motion[k];
      }
    advance(state, increment, 1);
  }
} // namespace fiberloom
