// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/stages/coat_settings.h>

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
      const auto  wants = [&names](const Export name) {
        return std::count(names.begin(), names.end(), name) > 0;
      };
      if (!wants(Export::surface) && !wants(Export::voxels) &&
          !wants(Export::abaqus))
        return;
      const auto   shapes = tow_shapes(fibers, mesh, q);
      const double size   = voxel_size(parameters.output.voxel_size,
                                     mesh.smallest_radius(),
                                     enclosing_box(shapes));
      if (wants(Export::surface))
        {
          const auto surfaces = tow_surfaces(shapes, .5 * size);
          write_file(directory + "surface.vtp", surfaces_vtp(surfaces));
          write_surfaces_stl(directory + "surface.stl", surfaces);
        }
      if (!wants(Export::voxels) && !wants(Export::abaqus))
        return;
      const VoxelGrid grid = fill_voxels(mesh, q, shapes, size);
      if (wants(Export::voxels))
        write_file(directory + "voxels.vti", voxels_vti(grid));
      if (wants(Export::abaqus))
        write_file(directory + "voxels.inp",
                   voxel_deck(grid,
                              fibers,
                              {matrix_of(parameters).young_modulus,
                               matrix_of(parameters).poisson_ratio}));
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
    for (const Export name : parameters.output.exports)
      if (name == Export::paths)
        write_file(directory + "paths.csv", paths_csv(fibers, mesh, q));
      else if (name == Export::texgen)
        write_file(directory + "texgen.xml", texgen_xml(fibers, mesh, q));
      else if (name == Export::fibers)
        write_file(directory + "fibers.vtp", fibers_vtp(fibers, mesh, q));
    write_bodies(parameters, fibers, mesh, q, directory);
  }
} // namespace fiberloom
