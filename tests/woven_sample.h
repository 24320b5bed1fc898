// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_tests_woven_sample_h
#define fiberloom_tests_woven_sample_h

#include <fiberloom/base/parameters.h>

#include <fiberloom/fabric/fabric_parameters.h>
#include <fiberloom/fabric/fiber_set.h>

#include <fiberloom/beams/fiber_mesh.h>

#include <cmath>
#include <fstream>
#include <string>

inline fiberloom::Parameters
parsed_scene(const std::string &scene)
{
  std::ofstream("scene.prm") << scene;
  fiberloom::Parameters parameters =
    fiberloom::Parameters::parse("scene.prm", {});
  fiberloom::resolve_fabric(parameters);
  return parameters;
}

/**
 * A plain weave of 2 x 3 tows of seven fibers, whose tows go over and under
 * each other as waves. So that hulls overlap, those of the warp are a little
 * less high than they would have to be.
 */
struct WovenSample
{
  fiberloom::Parameters parameters;
  fiberloom::FiberSet   fibers;
  fiberloom::FiberMesh  mesh;
  fiberloom::DofVector  q;

  explicit WovenSample(const double amplitude = .0115)
    : parameters(parsed_scene(
        "set Stages = weave\nsubsection Fabric\nsubsection Warp\nset Tows = 2\n"
        "set Elements per fiber = 12\nend\nsubsection Fill\n"
        "set Same as warp = true\nset Tows = 3\nset Elements per fiber = 8\n"
        "end\nend\n"))
    , fibers(fiberloom::build_fiber_set(parameters))
    , mesh(fibers)
    , q(mesh.reference())
  {
    const double pitch = parameters.fabric.warp.tow_spacing;
    for (const fiberloom::Tow &tow : fibers.tows)
      for (const unsigned int f : tow.fibers)
        {
          const auto &line        = mesh.lines()[f];
          const bool  is_warp     = tow.family == fiberloom::Tow::Family::warp;
          const unsigned int d    = is_warp ? 0 : 1;
          const double       half = .5 * (is_warp ? 3 : 2);
          for (unsigned int n = 0; n < line.n_nodes(); ++n)
            {
              auto         node  = q.segment<9>(9 * (line.first_node + n));
              const double phase = M_PI * (node[d] / pitch + half);
              const double sign =
                fibers.pattern->warp_above(is_warp ? tow.number : 0,
                                           is_warp ? 0 : tow.number) ==
                    is_warp ?
                  1 :
                  -1;
              const double slope =
                sign * amplitude * M_PI / pitch * std::cos(phase);
              node[2] += sign * amplitude * std::sin(phase);
              // The second section vector is upright in the flat fabric.
              const double       radius = line.radius;
              fiberloom::Vector3 up     = fiberloom::Vector3::UnitZ();
              up[d]                     = -slope;
              node.segment<3>(6)        = radius * up.normalized();
            }
        }
  }
};

#endif
