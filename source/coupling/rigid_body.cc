// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/coupling/rigid_body.h>

#include <cmath>

namespace fiberloom
{
  Vector3
  rotation_vector(const Eigen::Quaterniond &before,
                  const Eigen::Quaterniond &after,
                  const Vector3            &guess)
  {
    const Eigen::AngleAxisd rotation(after * before.conjugate());
    const double            turns =
      std::round((guess.dot(rotation.axis()) - rotation.angle()) / (2 * M_PI));
    return (rotation.angle() + 2 * M_PI * turns) * rotation.axis();
  }
} // namespace fiberloom
