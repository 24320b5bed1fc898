// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_fiber_samples_h
#define fiberloom_output_fiber_samples_h

#include <fiberloom/beams/fiber_mesh.h>

#include <vector>

namespace fiberloom
{
  /** What is shown of a fiber at one point of its length. */
  struct FiberSample
  {
    double  u; // parameter along the fiber, see FiberMesh
    Section section;
    Vector3 displacement;   // from the initial placement [mm]
    double  axial_force;    // [N]
    Vector3 bending_moment; // [N mm]
    double  torque;         // [N mm]
    double  curvature;      // [1/mm]
  };

  /**
   * Samples @p fiber at @p n_intervals equal intervals of each element, ends
   * included. Placements come from the quadratic interpolation; forces,
   * moments and curvature are extrapolated from the two Gauss points, where
   * they are most accurate, and averaged between the elements of a node.
   * Where @p history has broken the fiber there are none.
   */
  std::vector<FiberSample>
  sample_fiber(const FiberMesh    &mesh,
               const DofVector    &q,
               const unsigned int  fiber,
               const unsigned int  n_intervals,
               const FiberHistory &history = {});

  /** The same points without forces: parameter and section only. */
  std::vector<Section>
  sample_sections(const FiberMesh   &mesh,
                  const DofVector   &q,
                  const unsigned int fiber,
                  const unsigned int n_intervals);

  /**
   * Parameter u at which @p fiber passes @p plane along its normal, by Newton's
   * method from @p start ; that of its end if it ends before.
   */
  double
  parameter_on_plane(const FiberMesh                    &mesh,
                     const DofVector                    &q,
                     const unsigned int                  fiber,
                     const double                        start,
                     const Eigen::Hyperplane<double, 3> &plane);
} // namespace fiberloom

#endif
