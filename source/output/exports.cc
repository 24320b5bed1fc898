// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/output/exports.h>
#include <fiberloom/output/fiber_lines.h>
#include <fiberloom/output/files.h>
#include <fiberloom/output/paths.h>
#include <fiberloom/output/texgen.h>
#include <fiberloom/output/tow_surface.h>
#include <fiberloom/output/voxel_deck.h>
#include <fiberloom/output/voxels.h>

#include <algorithm>
#include <filesystem>

namespace fiberloom
{
  namespace
  {
    /** Those that need the tows as bodies. */
    void
    write_bodies(const Parameters  &parameters,
                 const FiberSet    &fibers,
                 const FiberMesh   &mesh,
                 const DofVector   &q,
                 const std::string &directory)
    {
      const auto &names = parameters.output.exports;
      const auto  wants = [&names](const char *name) {
        return std::count(names.begin(), names.end(), name) > 0;
      };
      if (!wants("surface") && !wants("voxels") && !wants("abaqus"))
        return;
      const auto   shapes = tow_shapes(fibers, mesh, q);
      const double size   = voxel_size(parameters.output.voxel_size,
                                     mesh.smallest_radius(),
                                     enclosing_box(shapes));
      if (wants("surface"))
        {
          const auto surfaces = tow_surfaces(shapes, .5 * size);
          write_file(directory + "surface.vtp", surfaces_vtp(surfaces));
          write_surfaces_stl(directory + "surface.stl", surfaces);
        }
      if (!wants("voxels") && !wants("abaqus"))
        return;
      const VoxelGrid grid = fill_voxels(mesh, q, shapes, size);
      if (wants("voxels"))
        write_file(directory + "voxels.vti", voxels_vti(grid));
      if (wants("abaqus"))
        write_file(directory + "voxels.inp",
                   voxel_deck(grid,
                              fibers,
                              {parameters.matrix.young_modulus,
                               parameters.matrix.poisson_ratio}));
    }
  } // namespace



  void
  write_exports(const Parameters &parameters,
                const FiberSet   &fibers,
                const FiberMesh  &mesh,
                const DofVector  &q)
  {
    if (parameters.output.exports.empty())
      return;
    const std::string directory = parameters.output_directory + "/export/";
    std::filesystem::create_directories(directory);
    for (const std::string &name : parameters.output.exports)
      if (name == "paths")
        write_file(directory + "paths.csv", paths_csv(fibers, mesh, q));
      else if (name == "texgen")
        write_file(directory + "texgen.xml", texgen_xml(fibers, mesh, q));
      else if (name == "fibers")
        write_file(directory + "fibers.vtp", fibers_vtp(fibers, mesh, q));
    write_bodies(parameters, fibers, mesh, q, directory);
  }
} // namespace fiberloom
