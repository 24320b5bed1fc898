// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// With two Gauss points and nothing else a disturbed section would oscillate
// along the fiber: contraction at the nodes 0, .436, .052, .413 ... of a
// stretched fiber with one stiff end, and a load on one node would squeeze
// sections many nodes away.

#include <cstdio>
#include <fstream>

#include "checks.h"
#include "dense_beams.h"
#include "sample_fibers.h"

using namespace fiberloom;

namespace
{
  constexpr unsigned int n_elements     = 6;
  constexpr double       element_length = 15, nu = .3;

  /** Along x, first section vector along z: dof 5 of a node is its length. */
  FiberMesh
  make_mesh(const unsigned int n)
  {
    return FiberMesh(loose_fibers({straight_fiber(
      Vector3::Zero(), Vector3(n * element_length, 0, 0), n, nu)}));
  }
} // namespace

int
main()
{
  std::ofstream   output("output");
  Checks          checks(output);
  const FiberMesh mesh = make_mesh(n_elements);
  Eigen::VectorXd residual;
  Eigen::MatrixXd tangent;
  assemble_dense(mesh, mesh.reference(), residual, tangent);

  // Stretched, the section of the first node rigid.
  Eigen::VectorXd force   = Eigen::VectorXd::Zero(residual.size());
  force[force.size() - 9] = 1;
  const Eigen::VectorXd pulled =
    solve_dense(tangent, force, {0, 1, 2, 3, 4, 5, 6, 7, 8});
  const double strain      = 1 / M_PI;
  double       oscillation = 0;
  for (unsigned int node = 1; node < mesh.n_nodes(); ++node)
    {
      const double contraction = -pulled[9 * node + 5] / strain;
      std::cout << contraction << ' ';
      oscillation = std::max(oscillation, std::abs(contraction - nu));
    }
  checks.below("contraction at the nodes less nu", oscillation, 1e-3);

  // Squeezed at one node, free otherwise.
  for (const unsigned int node : {6u, 7u})
    {
      force.setZero();
      force[9 * node + 5] = 1;
      const Eigen::VectorXd squeeze =
        solve_dense(tangent, force, {0, 1, 2, 3, 4, 6, 8});
      double far = 0;
      for (unsigned int other = 0; other < mesh.n_nodes(); ++other)
        if (std::abs(int(other) - int(node)) > 1)
          far = std::max(far, std::abs(squeeze[9 * other + 5]));
      checks.below("squeeze two nodes and more from node " +
                     std::to_string(node),
                   far / squeeze[9 * node + 5],
                   .02);
    }

  // The mode itself: t = (1, -1/2, 1) vanishes at both Gauss points. It costs
  // the plane-stress energy and, through its slope, some shear.
  const FiberMesh one = make_mesh(1);
  assemble_dense(one, one.reference(), residual, tangent);
  for (const bool shear : {false, true})
    {
      Eigen::VectorXd mode = Eigen::VectorXd::Zero(27);
      for (const unsigned int node : {0, 1, 2})
        {
          const double t = node == 1 ? -.5 : 1;
          // Elongation along z, or a shear of the section: both vectors lean.
          mode[9 * node + (shear ? 4 : 5)] = t;
          if (shear)
            mode[9 * node + 8] = -t;
        }
      const double G = 1 / (2 * (1 + nu));
      const double cured =
        .5 * M_PI * element_length / 2 * (shear ? 4 * G : 1 / (1 - nu * nu));
      // e14 or e15 and e24 are 6 xi / L and -6 xi / L at the Gauss points.
      const double slope =
        .5 * (shear ? 2 : 1) * G * M_PI / 4 * 12 / element_length;
      checks.below(std::string("energy of the mode in ") +
                     (shear ? "shear" : "elongation"),
                   .5 * mode.dot(tangent * mode) / (cured + slope) - 1,
                   1e-10);
      checks.below("without the cure its share would be", slope / cured, .02);
    }
}
