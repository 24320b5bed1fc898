// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_coupling_hold_h
#define fiberloom_coupling_hold_h

#include <fiberloom/base/choices.h>
#include <fiberloom/base/given_text.h>

#include <fiberloom/coupling/rigid_body.h>

#include <vector>

namespace fiberloom
{
  /**
   * The attachment of @p node to @p body , its frame along the section vectors
   * that the node has in @p q (columns: first, second, axis); the body's
   * axes are taken to be those of the sample.
   */
  Attachment
  attach(const DofVector   &q,
         const unsigned int node,
         const unsigned int body,
         const Hold         hold);

  /**
   * The same for what is held one by one: the centre along the axes of the
   * sample, the spin about the fiber's axis, the direction of that axis, or
   * only its tilt away from @p center . Throws InputError where the node has no
   * radial direction.
   */
  Attachment
  attach(const DofVector           &q,
         const unsigned int         node,
         const unsigned int         body,
         const NamedSet<PointHold> &held,
         const Vector3             &center);

  /**
   * A motion of a body, translation and rotation, that leaves all it holds
   * where it is although none of its prescribed dofs moves; zero if there is
   * none. @p attachments are those of the body, @p center is its reference
   * point.
   */
  Eigen::Matrix<double, 6, 1>
  idle_motion(const RigidBody               &body,
              const std::vector<Attachment> &attachments,
              const DofVector               &q,
              const Vector3                 &center);
} // namespace fiberloom

#endif
