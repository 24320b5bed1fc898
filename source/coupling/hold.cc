// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>

#include <fiberloom/coupling/hold.h>

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace fiberloom
{
  namespace
  {
    // Components along (first, second, axis): centre 0-2, r g1 3-5, r g2 6-8.
    // A section vector's own component is its length, which is never held.
    std::vector<unsigned int>
    held_components(const Hold hold)
    {
      switch (hold)
        {
          case Hold::clamped:
            return {0, 1, 2, 4, 5, 6, 8};
          case Hold::direction:
            return {0, 1, 2, 4, 5};
          case Hold::pinned:
            return {0, 1, 2, 4};
          case Hold::center:
            return {0, 1, 2};
          case Hold::axial:
            return {2};
        }
      return {};
    }
  } // namespace



  namespace
  {
    Attachment
    attach_nothing(const DofVector   &q,
                   const unsigned int node,
                   const unsigned int body)
    {
      Attachment attachment;
      attachment.node = node;
      attachment.body = body;

      const Vector3 first = q.segment<3>(9 * node + 3).normalized();
      const Vector3 axis = first.cross(q.segment<3>(9 * node + 6)).normalized();
      attachment.frame.col(0) = first;
      attachment.frame.col(1) = axis.cross(first);
      attachment.frame.col(2) = axis;
      return attachment;
    }

    /** From @p center to the node, across the fiber's axis. */
    Vector3
    radial_direction(const Attachment &attachment,
                     const DofVector  &q,
                     const Vector3    &center)
    {
      const Vector3 axis   = attachment.frame.col(2);
      const Vector3 lever  = q.segment<3>(9 * attachment.node) - center;
      const Vector3 radial = lever - axis * axis.dot(lever);
      if (!(radial.norm() >
            1e-6 * q.segment<3>(9 * attachment.node + 3).norm()))
        throw InputError("a fiber passes through the reference point, from "
                         "where nothing is radial");
      return radial.normalized();
    }
  } // namespace



  Attachment
  attach(const DofVector   &q,
         const unsigned int node,
         const unsigned int body,
         const Hold         hold)
  {
    Attachment attachment   = attach_nothing(q, node, body);
    attachment.center_frame = attachment.frame;
    for (const unsigned int component : held_components(hold))
      attachment.held.set(component);
    return attachment;
  }



  Attachment
  attach(const DofVector           &q,
         const unsigned int         node,
         const unsigned int         body,
         const NamedSet<PointHold> &held,
         const Vector3             &center)
  {
    Attachment attachment = attach_nothing(q, node, body);
    const bool spin       = held.has(PointHold::spin),
               tilt       = held.has(PointHold::tilt);
    attachment.held[0]    = held.has(PointHold::x);
    attachment.held[1]    = held.has(PointHold::y);
    attachment.held[2]    = held.has(PointHold::z);
    if (held.has(PointHold::radial))
      attachment.radial = radial_direction(attachment, q, center);
    if (spin)
      attachment.held.set(4);
    if (tilt)
      attachment.held.set(5).set(8);
    else if (held.has(PointHold::radial))
      attachment.held.set(5);
    if (spin && tilt)
      attachment.held.set(6);
    return attachment;
  }



  Eigen::Matrix<double, 6, 1>
  idle_motion(const RigidBody               &body,
              const std::vector<Attachment> &attachments,
              const DofVector               &q,
              const Vector3                 &center)
  {
    using Motion  = Eigen::Matrix<double, 6, 1>;
    using Motions = Eigen::Matrix<double, 6, 6>;
    Motions held  = Motions::Zero();
    for (const Attachment &attachment : attachments)
      for (unsigned int k = 0; k < 9; ++k)
        if (attachment.held[k])
          {
            const Matrix3 &frame =
              k < 3 ? attachment.center_frame : attachment.frame;
            const Vector3 direction = frame.col(k % 3);
            Vector3       lever = q.segment<3>(9 * attachment.node + k / 3 * 3);
            if (k < 3)
              lever -= center;
            const double radius = q.segment<3>(9 * attachment.node + 3).norm();
            Motion       slope;
            slope << (k < 3 ? direction : Vector3(Vector3::Zero())),
              lever.cross(direction) / radius;
            held += slope * slope.transpose();
          }
    // Prescribed dofs do not move of themselves: they count as held.
    const double scale = std::max(1., held.diagonal().maxCoeff());
    for (unsigned int k = 0; k < 6; ++k)
      if (body.prescribed[k])
        {
          held.row(k).setZero();
          held.col(k).setZero();
          held(k, k) = scale;
        }
    const Eigen::SelfAdjointEigenSolver<Motions> modes(held);
    if (modes.eigenvalues()[0] > 1e-10 * scale)
      return Motion::Zero();
    return modes.eigenvectors().col(0);
  }
} // namespace fiberloom
