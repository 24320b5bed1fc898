// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/output/slices.h>

#include <Eigen/Geometry>

#include <limits>

namespace fiberloom
{
  namespace
  {
    struct TowLine
    {
      Vector3 middle = Vector3::Zero();
      Vector3 direction =
        Vector3::Zero(); // end minus start, mean of the fibers
    };

    TowLine
    tow_line(const Tow &tow, const FiberMesh &mesh, const DofVector &q)
    {
      TowLine    result;
      const auto center = [&q](const unsigned int node) -> Vector3 {
        return q.segment<3>(FiberMesh::dofs_per_node * node);
      };
      for (const unsigned int fiber : tow.fibers)
        {
          const auto &line = mesh.lines()[fiber];
          Vector3     mean = Vector3::Zero();
          for (unsigned int n = 0; n < line.n_nodes(); ++n)
            mean += center(line.first_node + n) / line.n_nodes();
          result.middle += mean / tow.fibers.size();
          result.direction += center(line.first_node + line.n_nodes() - 1) -
                              center(line.first_node);
        }
      return result;
    }

    /** Smallest distance across the tow between neighbours of one layer. */
    double
    fiber_spacing(const FiberSet &fibers, const Tow &tow)
    {
      double smallest = std::numeric_limits<double>::max();
      for (const unsigned int a : tow.fibers)
        for (const unsigned int b : tow.fibers)
          if (a < b)
            smallest = std::min(smallest,
                                (fibers.fibers[a].centers.front() -
                                 fibers.fibers[b].centers.front())
                                  .norm());
      return tow.fibers.size() > 1 ? smallest : 0;
    }

    const Tow *
    middle_tow(const FiberSet &fibers, const Tow::Family family)
    {
      std::vector<const Tow *> members;
      for (const Tow &tow : fibers.tows)
        if (tow.family == family)
          members.push_back(&tow);
      return members.empty() ? nullptr : members[members.size() / 2];
    }

    SlicePlane
    plane_along_tow(const FiberSet  &fibers,
                    const Tow       &tow,
                    const FiberMesh &mesh,
                    const DofVector &q)
    {
      const bool    warp = tow.family == Tow::Family::warp;
      const TowLine line = tow_line(tow, mesh, q);

      SlicePlane plane;
      plane.name = warp ? "warp" : "fill";
      plane.title =
        "cut along " + plane.name + " tow " + std::to_string(tow.number + 1);
      plane.up    = Vector3::UnitZ();
      plane.along = Vector3(line.direction[0], line.direction[1], 0);
      plane.along.normalize();
      plane.origin =
        line.middle + .25 * fiber_spacing(fibers, tow) * plane.normal();
      return plane;
    }

    SlicePlane
    plane_across_first_fiber(const FiberSet  &fibers,
                             const FiberMesh &mesh,
                             const DofVector &q)
    {
      const TowLine line = tow_line(fibers.tows.front(), mesh, q);
      const Vector3 axis = line.direction.normalized();
      const Vector3 up =
        std::abs(axis[2]) < .9 ? Vector3::UnitZ() : Vector3::UnitY();

      SlicePlane plane;
      plane.name   = "middle";
      plane.title  = "cut across the first fiber at its middle";
      plane.along  = up.cross(axis).normalized();
      plane.up     = axis.cross(plane.along);
      plane.origin = mesh
                       .section(q,
                                mesh.locate(fibers.tows.front().fibers.front(),
                                            .5 * mesh.lines()[0].n_elements))
                       .center;
      return plane;
    }
  } // namespace



  std::vector<SlicePlane>
  slice_planes(const FiberSet  &fibers,
               const FiberMesh &mesh,
               const DofVector &q,
               const Slices     which)
  {
    std::vector<SlicePlane> planes;
    if (which == Slices::none || fibers.tows.empty())
      return planes;
    if (fibers.tows.front().family == Tow::Family::none)
      planes.push_back(plane_across_first_fiber(fibers, mesh, q));

    for (const auto family : {Tow::Family::warp, Tow::Family::fill})
      {
        const bool wanted =
          which == Slices::both ||
          which == (family == Tow::Family::warp ? Slices::warp : Slices::fill);
        if (const Tow *tow = middle_tow(fibers, family); tow && wanted)
          planes.push_back(plane_along_tow(fibers, *tow, mesh, q));
      }
    return planes;
  }
} // namespace fiberloom
