// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/model/held_nodes.h>

#include <algorithm>

namespace fiberloom
{
  Matrix3
  cross_matrix(const Vector3 &v)
  {
    Matrix3 m;
    m << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
    return m;
  }



  namespace
  {
    using SectionVector = Eigen::Matrix<double, 6, 1>; // r g1, r g2
    using SectionBasis  = Eigen::Matrix<double, 6, 6>;

    /**
     * The section vectors' change by that of their components, see
     * Attachment; @p section is what they are now.
     */
    SectionBasis
    section_basis(const Attachment    &attachment,
                  const Matrix3       &rotation,
                  const SectionVector &section)
    {
      SectionBasis basis = SectionBasis::Zero();
      if (attachment.radial.isZero(0))
        {
          basis.topLeftCorner<3, 3>() = basis.bottomRightCorner<3, 3>() =
            rotation * attachment.frame;
          return basis;
        }

      const Vector3 g1 = section.head<3>(), g2 = section.tail<3>();
      Matrix3       frame;
      frame.col(0) = rotation * attachment.radial;
      frame.col(1) = g1.cross(g2).cross(frame.col(0)).normalized();
      frame.col(2) = frame.col(0).cross(frame.col(1));

      // The section's own coordinates of the radial direction.
      Eigen::Matrix2d gram;
      gram << g1.dot(g1), g1.dot(g2), g1.dot(g2), g2.dot(g2);
      const Eigen::Vector2d turned =
        gram.ldlt()
          .solve(Eigen::Vector2d(g1.dot(frame.col(0)), g2.dot(frame.col(0))))
          .normalized();
      basis.topLeftCorner<3, 3>() = basis.bottomRightCorner<3, 3>() =
        turned[0] * frame;
      basis.topRightCorner<3, 3>()   = -turned[1] * frame;
      basis.bottomLeftCorner<3, 3>() = turned[1] * frame;
      return basis;
    }

    /** Tilts a section until its axis is across @p radial again. */
    SectionVector
    level(const SectionVector &section, const Vector3 &radial)
    {
      const Vector3 g1 = section.head<3>(), g2 = section.tail<3>();
      const Vector3 axis = g1.cross(g2).normalized();
      const auto    tilt =
        Eigen::Quaterniond::FromTwoVectors(axis,
                                           axis - radial * radial.dot(axis));
      SectionVector leveled;
      leveled << tilt * g1, tilt * g2;
      return leveled;
    }
  } // namespace



  NodeVector
  move_held_node(const Attachment &attachment,
                 const Placement  &before,
                 const Placement  &after,
                 const NodeVector &dofs,
                 const NodeVector &local_change)
  {
    const Matrix3 old_rotation = before.rotation.toRotationMatrix();
    const Matrix3 new_rotation = after.rotation.toRotationMatrix();
    // Exactly, where nothing turns: rounding would add up over the iterations.
    Matrix3 turn = Matrix3::Identity();
    if (after.rotation.coeffs() != before.rotation.coeffs())
      turn = new_rotation * old_rotation.transpose();

    SectionVector section = dofs.tail<6>();
    section +=
      section_basis(attachment, old_rotation, section) * local_change.tail<6>();
    section.head<3>() = (turn * section.head<3>()).eval();
    section.tail<3>() = (turn * section.tail<3>()).eval();
    if (!attachment.radial.isZero(0))
      section = level(section, new_rotation * attachment.radial);

    NodeVector moved;
    moved.tail<6>() = section;
    if (attachment.carried)
      {
        moved.head<3>() =
          dofs.head<3>() +
          *attachment.carried * (after.position - before.position) +
          attachment.center_frame * local_change.head<3>();
        return moved;
      }
    moved.head<3>() =
      after.position + turn * (dofs.head<3>() - before.position) +
      new_rotation * attachment.center_frame * local_change.head<3>();
    return moved;
  }



  NodeVector
  local_change(const Attachment &attachment,
               const Placement  &before,
               const Placement  &after,
               const NodeVector &dofs_before,
               const NodeVector &dofs_after)
  {
    const NodeVector carried = move_held_node(
      attachment, before, after, dofs_before, NodeVector::Zero());
    const Matrix3    rotation = after.rotation.toRotationMatrix();
    const NodeVector moved    = dofs_after - carried;

    NodeVector local;
    local.head<3>() =
      (rotation * attachment.center_frame).transpose() * moved.head<3>();
    local.tail<6>() =
      section_basis(attachment, rotation, carried.tail<6>()).transpose() *
      moved.tail<6>();
    for (unsigned int k = 0; k < 9; ++k)
      if (attachment.held[k])
        local[k] = 0;
    return local;
  }



  HeldGroup::HeldGroup(const dealii::ArrayView<const unsigned int> &nodes,
                       const std::vector<int>       &attachment_of_node,
                       const Supports               &supports,
                       const BlockLayout            &layout,
                       const std::vector<NodeImage> &images)
    : n_nodes(nodes.size())
    , supports(supports)
    , layout(layout)
    , blocks(nodes.begin(), nodes.end())
    , held(n_nodes, nullptr)
    , carried(n_nodes)
    , body_position(n_nodes, 0)
  {
    for (unsigned int a = 0; a < n_nodes; ++a)
      {
        int body = -1;
        if (nodes[a] < images.size())
          if (const NodeImage &image = images[nodes[a]];
              image.node != nodes[a] || image.periods != std::array<int, 2>())
            {
              blocks[a] = image.node;
              body      = supports.cell->body;
              carried[a] =
                supports.cell->slope(image.periods[0], image.periods[1]);
            }
        if (const int i = blocks[a] < attachment_of_node.size() ?
                            attachment_of_node[blocks[a]] :
                            -1; // a body
            i >= 0)
          {
            held[a] = &supports.attachments[i];
            body    = held[a]->body;
            if (held[a]->carried)
              carried[a] =
                carried[a].value_or(Matrix3::Zero()) + *held[a]->carried;
          }
        if (body >= 0)
          body_position[a] = position_of_body(layout.body_block(body));
      }
    offsets.push_back(0);
    for (const unsigned int block : blocks)
      offsets.push_back(offsets.back() + layout.size(block));
    forces.setZero(offsets.back());
    matrix.setZero(offsets.back(), offsets.back());
  }



  unsigned int
  HeldGroup::position_of_body(const unsigned int block)
  {
    auto found = std::find(blocks.begin() + n_nodes, blocks.end(), block);
    if (found == blocks.end())
      found = blocks.insert(blocks.end(), block);
    return found - blocks.begin();
  }



  template <int n_dofs>
  void
  HeldGroup::transform_node(const unsigned int            a,
                            const DofVector              &q,
                            const std::vector<Placement> &placements,
                            const Parts                   parts,
                            Eigen::MatrixXd              &geometric)
  {
    using Dofs   = Eigen::Matrix<double, n_dofs, 1>;
    using Basis  = Eigen::Matrix<double, n_dofs, n_dofs>;
    using Motion = Eigen::Matrix<double, n_dofs, 6>; // by that of the body

    const Placement   &placement = placements[held[a]->body];
    const Matrix3      turned    = placement.rotation.toRotationMatrix();
    const Dofs         node  = q.segment<n_dofs>(layout.first_dof(blocks[a]));
    const Dofs         force = forces.segment<n_dofs>(offset(a));
    const unsigned int first = offset(a);
    const unsigned int body  = offset(body_position[a]);
    const unsigned int rotation = body + 3;

    Basis basis                          = Basis::Zero();
    basis.template topLeftCorner<3, 3>() = turned * held[a]->center_frame;
    if constexpr (n_dofs == 9)
      basis.template bottomRightCorner<6, 6>() =
        section_basis(*held[a], turned, node.template tail<6>());
    Motion motion = Motion::Zero();
    motion.template topLeftCorner<3, 3>().setIdentity();

    for (unsigned int v = 0; v < n_dofs / 3; ++v)
      {
        Vector3 lever = node.template segment<3>(3 * v);
        if (v == 0)
          lever -= placement.position;
        motion.template block<3, 3>(3 * v, 3) = -cross_matrix(lever);

        const Vector3 f = force.template segment<3>(3 * v);
        geometric.block<3, 3>(rotation, rotation) +=
          .5 * (f * lever.transpose() + lever * f.transpose()) -
          f.dot(lever) * Matrix3::Identity();
        const Eigen::Matrix<double, 3, n_dofs> mixed =
          -cross_matrix(f) * basis.template middleRows<3>(3 * v);
        geometric.block<3, n_dofs>(rotation, first) += mixed;
        geometric.block<n_dofs, 3>(first, rotation) += mixed.transpose();
      }
    if constexpr (n_dofs == 9)
      if (!held[a]->radial.isZero(0))
        {
          // Where the first vector has turned in the section and the second
          // one is tilted, leveling lifts both.
          const NodeVector h = basis.transpose() * node;
          const double     lift =
            (basis.col(5).dot(force) + h[6] / h[3] * basis.col(8).dot(force)) /
            h[7];
          geometric(first + 4, first + 8) += lift;
          geometric(first + 8, first + 4) += lift;
        }

    apply<n_dofs>(a, basis, motion, parts);
  }



  template <int n_dofs>
  void
  HeldGroup::transform_carried(const unsigned int a, const Parts parts)
  {
    using Basis  = Eigen::Matrix<double, n_dofs, n_dofs>;
    using Motion = Eigen::Matrix<double, n_dofs, 6>;
    Basis basis  = Basis::Identity();
    if (held[a] != nullptr)
      {
        basis.template topLeftCorner<3, 3>() = held[a]->center_frame;
        for (int v = 3; v < n_dofs; v += 3)
          basis.template block<3, 3>(v, v) = held[a]->frame;
      }
    Motion motion                         = Motion::Zero();
    motion.template topLeftCorner<3, 3>() = *carried[a];
    apply<n_dofs>(a, basis, motion, parts);
  }



  template <int n_dofs>
  void
  HeldGroup::apply(const unsigned int                           a,
                   const Eigen::Matrix<double, n_dofs, n_dofs> &basis,
                   const Eigen::Matrix<double, n_dofs, 6>      &motion,
                   const Parts                                  parts)
  {
    const unsigned int                     first = offset(a);
    const unsigned int                     body  = offset(body_position[a]);
    const Eigen::Matrix<double, n_dofs, 1> force =
      forces.segment<n_dofs>(first);
    forces.segment<n_dofs>(first) = basis.transpose() * force;
    forces.segment<6>(body) += motion.transpose() * force;
    if (parts == Parts::forces)
      return;

    // Other columns stay: far less work than a product with the whole map.
    const Eigen::Matrix<double, Eigen::Dynamic, n_dofs> columns =
      matrix.middleCols<n_dofs>(first);
    matrix.middleCols<n_dofs>(first).noalias() = columns * basis;
    matrix.middleCols<6>(body) += columns * motion;
    const Eigen::Matrix<double, n_dofs, Eigen::Dynamic> rows =
      matrix.middleRows<n_dofs>(first);
    matrix.middleRows<n_dofs>(first).noalias() = basis.transpose() * rows;
    matrix.middleRows<6>(body) += motion.transpose() * rows;
  }



  void
  HeldGroup::transform(const DofVector              &q,
                       const std::vector<Placement> &placements,
                       const Parts                   parts)
  {
    const unsigned int n         = forces.size();
    Eigen::MatrixXd    geometric = Eigen::MatrixXd::Zero(n, n);
    for (unsigned int a = 0; a < n_nodes; ++a)
      if (carried[a])
        {
          if (size(a) == 9)
            transform_carried<9>(a, parts);
          else
            transform_carried<3>(a, parts);
        }
      else if (held[a] != nullptr)
        {
          if (size(a) == 9)
            transform_node<9>(a, q, placements, parts, geometric);
          else
            transform_node<3>(a, q, placements, parts, geometric);
        }
    if (parts == Parts::forces_and_stiffness)
      matrix += geometric;
  }
} // namespace fiberloom
