// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_base_curvature_h
#define fiberloom_base_curvature_h

namespace fiberloom
{
  /** What of an energy's Hessian is asked for: nothing; without what makes
   * it indefinite as normals of contacts turn and their points slide, and with
   * the absolute value of what stresses in fibers add to it; without that of
   * contacts alone; or all. */
  enum class Curvature
  {
    none,
    convex,
    positive,
    exact
  };
} // namespace fiberloom

#endif
