// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/model/held_nodes.h>

#include <algorithm>

namespace fiberloom
{
  namespace
  {
    Matrix3
    cross_matrix(const Vector3 &v)
    {
      Matrix3 m;
      m << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
      return m;
    }
  } // namespace



  NodeVector
  move_held_node(const Attachment &attachment,
                 const Placement  &before,
                 const Placement  &after,
                 const NodeVector &dofs,
                 const NodeVector &local_change)
  {
    const Matrix3 old_frame =
      before.rotation.toRotationMatrix() * attachment.frame;
    const Matrix3 new_frame =
      after.rotation.toRotationMatrix() * attachment.frame;
    NodeVector moved;
    for (unsigned int v = 0; v < 3; ++v)
      {
        const Vector3 from =
          (v == 0) ? before.position : Vector3(Vector3::Zero());
        const Vector3 to = (v == 0) ? after.position : Vector3(Vector3::Zero());
        moved.segment<3>(3 * v) =
          to +
          new_frame * (old_frame.transpose() * (dofs.segment<3>(3 * v) - from) +
                       local_change.segment<3>(3 * v));
      }
    return moved;
  }



  HeldGroup::HeldGroup(const unsigned int     *nodes,
                       const unsigned int      n_nodes,
                       const std::vector<int> &attachment_of_node,
                       const Supports         &supports,
                       const BlockLayout      &layout)
    : n_nodes(n_nodes)
    , supports(supports)
    , blocks(nodes, nodes + n_nodes)
    , held(n_nodes, nullptr)
    , body_position(n_nodes, 0)
  {
    for (unsigned int a = 0; a < n_nodes; ++a)
      if (const int i = attachment_of_node[nodes[a]]; i >= 0)
        {
          held[a] = &supports.attachments[i];
          const unsigned int body =
            layout.body_block(supports.attachments[i].body);
          auto found = std::find(blocks.begin() + n_nodes, blocks.end(), body);
          if (found == blocks.end())
            found = blocks.insert(blocks.end(), body);
          body_position[a] = found - blocks.begin();
        }
    const unsigned int n = offset(blocks.size());
    forces.setZero(n);
    matrix.setZero(n, n);
  }



  void
  HeldGroup::transform(const DofVector              &q,
                       const std::vector<Placement> &placements,
                       const bool                    with_tangent)
  {
    const unsigned int n         = forces.size();
    Eigen::MatrixXd    map       = Eigen::MatrixXd::Identity(n, n);
    Eigen::MatrixXd    geometric = Eigen::MatrixXd::Zero(n, n);
    for (unsigned int a = 0; a < n_nodes; ++a)
      {
        if (held[a] == nullptr)
          continue;
        const Placement &placement = placements[held[a]->body];
        const Matrix3    frame =
          placement.rotation.toRotationMatrix() * held[a]->frame;
        const unsigned int body     = offset(body_position[a]);
        const unsigned int rotation = body + 3;
        for (unsigned int v = 0; v < 3; ++v)
          {
            const unsigned int dof   = 9 * a + 3 * v;
            Vector3            lever = q.segment<3>(9 * blocks[a] + 3 * v);
            if (v == 0)
              {
                lever -= placement.position;
                map.block<3, 3>(dof, body).setIdentity();
              }
            map.block<3, 3>(dof, dof)      = frame;
            map.block<3, 3>(dof, rotation) = -cross_matrix(lever);

            const Vector3 f = forces.segment<3>(dof);
            geometric.block<3, 3>(rotation, rotation) +=
              .5 * (f * lever.transpose() + lever * f.transpose()) -
              f.dot(lever) * Matrix3::Identity();
            const Matrix3 mixed = -cross_matrix(f) * frame;
            geometric.block<3, 3>(rotation, dof) += mixed;
            geometric.block<3, 3>(dof, rotation) += mixed.transpose();
          }
      }
    forces = map.transpose() * forces;
    if (with_tangent)
      matrix = map.transpose() * matrix * map + geometric;
  }
} // namespace fiberloom
