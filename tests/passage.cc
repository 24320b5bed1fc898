// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// No increment is accepted on whose way a fiber may have passed through
// another: straight ways of the nodes that meet, those that do not, and a run
// whose only increment would carry one fiber through the other.

#include <fiberloom/contact/passage.h>

#include <deal.II/base/mpi.h>

#include <fstream>

#include "checks.h"
#include "run_stages.h"
#include "sample_fibers.h"

using namespace fiberloom;

namespace
{
  struct Pair
  {
    const FiberSet  fibers;
    const FiberMesh mesh;
    ProximitySearch search;

    Pair()
      : fibers(loose_fibers(
          {straight_fiber(Vector3(-20, 0, 0), Vector3(20, 0, 0), 4),
           straight_fiber(Vector3(0, -20, 6), Vector3(0, 20, 6), 4)}))
      , mesh(fibers)
      , search(mesh, .3, .5, ProximitySearch::Pairs::of_two_fibers)
    {}

    /** The second fiber goes by @p motion , then everything turns about a
     * slanted axis. */
    bool
    passes(const Vector3 &motion, const double angle = 0) const
    {
      const Eigen::AngleAxisd turn(angle, Vector3(1, 2, 2) / 3);
      DofVector               after = mesh.reference();
      for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
        {
          if (n >= mesh.lines()[1].first_node)
            after.segment<3>(9 * n) += motion;
          after.segment<3>(9 * n) = turn * Vector3(after.segment<3>(9 * n));
        }
      return may_pass(mesh,
                      search.meeting(mesh.reference(), after),
                      mesh.reference(),
                      after);
    }
  };

  void
  check_run(Checks &checks)
  {
    std::ofstream scene("crossed.prm");
    scene << "set Stages = load\nset Drives = lower, upper\n"
             "subsection Fibers\n"
             "set Polylines = -.5 0 0, .5 0 0; 0 -.5 .2, 0 .5 .2\n"
             "set Radius = .008\nset Elements per fiber = 16\nend\n"
             "subsection Drive lower\nset Ends = 0 start, 0 end\nend\n"
             "subsection Drive upper\nset Ends = 1 start, 1 end\n"
             "set Translation = 0; 0; -.8*t\nend\n";
    scene.close();
    Parameters parameters = Parameters::parse("crossed.prm", {});
    double     above      = -1;
    unsigned   rejected   = 0;
    run_stages(parameters,
               build_fiber_set(parameters),
               [&](const IncrementReport &report) {
                 const DofVector   &q = report.state.q;
                 const unsigned int n = q.size() / 18;
                 above    = q[9 * (n + n / 2) + 2] - q[9 * (n / 2) + 2];
                 rejected = report.statistics.rejected_increments;
               });
    checks.above("centre lines apart, over their radii", above / .016, .5);
    checks.above("rejected increments", rejected, 0);
  }
} // namespace



int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::ofstream                            output("output");
  Checks                                   checks(output);

  const Pair pair;
  checks.that("through the other fiber", pair.passes(Vector3(0, 0, -12)));
  checks.that("through it, with a turn", pair.passes(Vector3(0, 0, -12), .5));
  checks.that("up to it", !pair.passes(Vector3(0, 0, -4)));
  checks.that("away from it", !pair.passes(Vector3(0, 0, 40)));
  checks.that("beyond its end", !pair.passes(Vector3(50, 0, -12)));
  checks.that("both turned by far", !pair.passes(Vector3::Zero(), 3));
  checks.that("up to it, turned by far", !pair.passes(Vector3(0, 0, -4), 2.5));
  check_run(checks);
}
