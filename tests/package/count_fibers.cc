// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// Reads a scene and tells of how many fibers and nodes it is.

#include <fiberloom/fabric/fabric_parameters.h>

#include <fiberloom/beams/fiber_mesh.h>

#include <iostream>

int
main(int argc, char **argv)
{
  if (argc != 2)
    {
      std::cerr << "usage: count_fibers SCENE.prm" << std::endl;
      return 1;
    }
  using namespace fiberloom;
  Parameters parameters = Parameters::parse(argv[1], {});
  resolve_fabric(parameters);
  const FiberSet  fibers = build_fiber_set(parameters);
  const FiberMesh mesh(fibers);
  std::cout << fibers.fibers.size() << " fibers, " << mesh.n_nodes() << " nodes"
            << std::endl;
}
