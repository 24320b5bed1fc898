// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/stages/ply_stack.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace fiberloom
{
  namespace
  {
    // Points of an axis, over the radius: crossing fibers are seen to be
    // further apart than they are by less than a hundredth of it.
    constexpr double sample_spacing = .25;

    struct Sample
    {
      Vector3 center; // [mm]
      double  radius;
    };

    std::vector<Sample>
    samples_of_ply(const Scene &scene, const DofVector &q, const unsigned int p)
    {
      std::vector<Sample> samples;
      for (unsigned int f = 0; f < scene.mesh.lines().size(); ++f)
        {
          const FiberMesh::Line &line = scene.mesh.lines()[f];
          if (scene.fibers.tows[line.tow].ply != p)
            continue;
          const unsigned int n =
            std::ceil(line.length / (sample_spacing * line.radius));
          for (unsigned int k = 0; k < n; ++k)
            samples.push_back(
              {scene.mesh
                 .section(q,
                          scene.mesh.locate(f, k * line.n_elements / double(n)))
                 .center,
               line.radius});
        }
      return samples;
    }

    /** Samples by diamonds of a cell, which are no narrower than a fiber and go
     * on beyond its borders. */
    class PlanBins
    {
    public:
      PlanBins(const Eigen::Matrix2d &periods, const double width)
        : periods(periods)
        , in_periods(periods.inverse())
      {
        for (unsigned int d = 0; d < 2; ++d)
          n[d] =
            std::max(1,
                     static_cast<int>(1 / (in_periods.row(d).norm() * width)));
        bins.resize(n[0] * n[1]);
      }

      void
      add(const std::vector<Sample> &samples)
      {
        for (const Sample &sample : samples)
          bins[bin(square(sample, 0), square(sample, 1))].push_back(sample);
      }

      /** Of @p above over all that has been added [mm]. */
      double
      clearance(const Sample &above) const
      {
        double least = std::numeric_limits<double>::max();
        for (const int i : {-1, 0, 1})
          for (const int j : {-1, 0, 1})
            for (const Sample &below :
                 bins[bin(square(above, 0) + i, square(above, 1) + j)])
              {
                const Vector3         way   = above.center - below.center;
                const double          reach = above.radius + below.radius;
                const Eigen::Vector2d along = in_periods * way.head<2>();
                const double          apart =
                  (periods * (along - along.array().round().matrix())).norm();
                if (apart < reach)
                  least = std::min(least,
                                   way.z() - std::sqrt((reach - apart) *
                                                       (reach + apart)));
              }
        return least;
      }

    private:
      const Eigen::Matrix2d            periods, in_periods;
      std::array<int, 2>               n;
      std::vector<std::vector<Sample>> bins;

      int
      square(const Sample &sample, const unsigned int d) const
      {
        return std::floor(in_periods.row(d).dot(sample.center.head<2>()) *
                          n[d]);
      }

      std::size_t
      bin(const int i, const int j) const
      {
        return ((i % n[0] + n[0]) % n[0]) * n[1] + (j % n[1] + n[1]) % n[1];
      }
    };
  } // namespace



  void
  close_stack(const Scene           &scene,
              const Eigen::Matrix2d &periods,
              const double           depth,
              DofVector             &q)
  {
    PlanBins below(periods, 2 * scene.mesh.largest_radius());
    for (unsigned int p = 0; p < scene.fibers.n_plies(); ++p)
      {
        std::vector<Sample> ply = samples_of_ply(scene, q, p);
        if (p > 0)
          {
            double clearance = std::numeric_limits<double>::max();
            for (const Sample &sample : ply)
              clearance = std::min(clearance, below.clearance(sample));
            const double way = clearance + depth;
            for (Sample &sample : ply)
              sample.center.z() -= way;
            for (const FiberMesh::Line &line : scene.mesh.lines())
              if (scene.fibers.tows[line.tow].ply == p)
                for (unsigned int n = 0; n < line.n_nodes(); ++n)
                  q[9 * (line.first_node + n) + 2] -= way;
          }
        below.add(ply);
      }
  }
} // namespace fiberloom
