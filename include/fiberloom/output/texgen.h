// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_texgen_h
#define fiberloom_output_texgen_h

#include <fiberloom/fabric/fiber_set.h>

#include <fiberloom/beams/fiber_mesh.h>

#include <string>

namespace fiberloom
{
  /**
   * The tows as yarns of a model of TexGen, in its XML: at each node of the
   * fibers a point of the mean line and the hull of the fibers as a polygon,
   * whose corners lie at the same angles around it in all sections.
   */
  std::string
  texgen_xml(const FiberSet &fibers, const FiberMesh &mesh, const DofVector &q);
} // namespace fiberloom

#endif
