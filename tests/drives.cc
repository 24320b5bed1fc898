// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// What drives can do in stage "load": turn an end many times, prescribed and by
// a moment; turn fibers about a point beside them; hold the ends of a beam one
// by one as a hinge and a roller; carry fibers under their own weight and a
// line load, in balance. Friction between two fibers loses mu N times the
// sliding.

#include <fiberloom/fabric/fabric_parameters.h>

#include <deal.II/base/mpi.h>

#include <fstream>
#include <iomanip>
#include <map>
#include <sstream>

#include "checks.h"
#include "run_stages.h"

using namespace fiberloom;

namespace
{
  using Row = std::map<std::string, double>;

  std::string
  number(const double value)
  {
    std::ostringstream out;
    out << std::setprecision(15) << value;
    return out.str();
  }

  /** The loading curve of stage "load" of a scene. */
  std::vector<Row>
  run_load(const std::string &scene_text)
  {
    std::ofstream("scene.prm") << "set Stages = load\n" << scene_text;
    Parameters parameters = Parameters::parse("scene.prm", {});
    resolve_fabric(parameters);

    std::vector<Row> rows;
    run_stages(parameters,
               build_fiber_set(parameters),
               [&rows](const IncrementReport &report) {
                 rows.emplace_back();
                 for (const auto &[column, value] : report.curve)
                   rows.back()[column.heading()] = value;
               });
    return rows;
  }

  std::string
  drive(const std::string &name, const std::string &entries)
  {
    return "subsection Drive " + name + "\n" + entries + "end\n";
  }

  // nu = 0: G J = E I
  constexpr double radius = .01, young_modulus = 1000,
                   bending_stiffness = young_modulus * M_PI * radius * radius *
                                       radius * radius / 4;

  std::string
  fibers(const std::string &polylines, const unsigned int n_elements)
  {
    return "subsection Fibers\nset Polylines = " + polylines +
           "\nset Radius = " + number(radius) +
           "\nset Young modulus = " + number(young_modulus) +
           "\nset Poisson ratio = 0\nset Density = 2e-9\n"
           "set Elements per fiber = " +
           std::to_string(n_elements) + "\nend\n";
  }

  /**
   * Three turns of a long fiber, kept straight by a little tension: its torque
   * G J phi' (1 - 5/6 (r phi')^2), by a prescribed rotation and by a moment.
   */
  void
  check_turns(Checks &checks)
  {
    const double length = 15, turns = 6 * M_PI, rate = turns / length,
                 torque = bending_stiffness * rate *
                          (1 - 5. / 6 * std::pow(radius * rate, 2));
    const std::string text = "set Drives = clamp, tip\n" +
                             fibers("0 0 0, " + number(length) + " 0 0", 50) +
                             drive("clamp", "set Ends = 0 start\n");
    const std::string pull =
      "set Ends = 0 end\nset Translation = 0.003*t; 0; 0\n";

    const Row prescribed =
      run_load(text + drive("tip", pull + "set Rotation = 6*pi*t; 0; 0\n"))
        .back();
    checks.below("three turns: rotation",
                 prescribed.at("tip_rx[rad]") / turns - 1,
                 1e-9);
    checks.below("three turns: torque",
                 prescribed.at("tip_moment_x[N.mm]") / torque - 1,
                 1e-3);

    const Row loaded =
      run_load("subsection Load\nset First step = 0.05\n"
               "set Largest step = 0.05\nend\n" +
               text +
               drive("tip",
                     pull + "set Free = rx\nset Moment = " + number(torque) +
                       "*t; 0; 0\n"))
        .back();
    checks.below("three turns by a moment",
                 loaded.at("tip_rx[rad]") / turns - 1,
                 1e-3);
    checks.below("balance of the moment",
                 loaded.at("clamp_moment_x[N.mm]") / torque + 1,
                 1e-6);
  }

  /** Ten turns about a point beside the fiber move it without strain. */
  void
  check_center(Checks &checks)
  {
    const auto rows = run_load(
      "set Drives = ends\nsubsection Load\nset Probes = 0 at 0.3\nend\n" +
      fibers("0 2 0, 1 2 0", 5) +
      drive("ends",
            "set Ends = all start, all end\nset Center = 0.1 0.2 0\n"
            "set Rotation = 0; 0; 20*pi*t\n"));
    const Vector3 center(.1, .2, 0), arm = Vector3(.3, 2, 0) - center;
    double        error = 0, energy = 0;
    for (const Row &row : rows)
      {
        const Vector3 expected =
          center +
          Eigen::AngleAxisd(row.at("ends_rz[rad]"), Vector3::UnitZ()) * arm;
        error  = std::max(error,
                         (expected - Vector3(row.at("probe_0_at_0.3_x[mm]"),
                                             row.at("probe_0_at_0.3_y[mm]"),
                                             row.at("probe_0_at_0.3_z[mm]")))
                           .norm());
        energy = std::max(energy, row.at("elastic_energy[N.mm]"));
      }
    checks.above("increments of ten turns", rows.size(), 239);
    checks.below("ten turns about a point: rotation",
                 rows.back().at("ends_rz[rad]") - 20 * M_PI,
                 1e-9);
    checks.below("ten turns about a point: place", error, 1e-8);
    checks.below("ten turns about a point: energy over E A L",
                 energy / (young_modulus * M_PI * radius * radius),
                 1e-14);
  }

  /** Small deflections of a beam of length 1 against the closed forms. */
  void
  check_line_loads(Checks &checks)
  {
    const double weight = 2e-9 * M_PI * radius * radius * 9810;
    const Row    cantilever =
      run_load("set Drives = clamp\nsubsection Load\nset Probes = 0 end\n"
               "set Gravity = 0; 0; -9810*t\nend\n" +
               fibers("0 0 0, 1 0 0", 8) +
               drive("clamp", "set Ends = 0 start\n"))
        .back();
    checks.below("own weight: deflection",
                 cantilever.at("probe_0_end_z[mm]") /
                     (-weight / (8 * bending_stiffness)) -
                   1,
                 1e-3);
    checks.below("own weight: force of the clamp",
                 cantilever.at("clamp_force_z[N]") / weight - 1,
                 1e-8);
    checks.below("own weight: moment of the clamp",
                 cantilever.at("clamp_moment_y[N.mm]") / (-weight / 2) - 1,
                 1e-5);

    // Unrolled over two phases; the roller gives way to the shortening.
    const double load = 6e-8;
    const auto   rows = run_load(
      "set Drives = hinge, roller\nsubsection Load\nset Probes = 0 at 0.5\n"
        "set End = 2\nset First step = 0.7\nset Largest step = 0.7\n"
        "set Line load = 0; 0; -" +
      number(load) + "*min(t, 1)\nend\n" + fibers("0 0 0, 1 0 0", 8) +
      drive("hinge", "set Ends = 0 start\nset Held = x y z spin\n") +
      drive("roller", "set Ends = 0 end\nset Held = y z\n"));
    checks.equal("an increment ends where t is 1", rows[2].at("t"), 1);
    const Row &beam = rows.back();
    checks.below("hinge and roller: deflection",
                 beam.at("probe_0_at_0.5_z[mm]") /
                     (-5 * load / (384 * bending_stiffness)) -
                   1,
                 2e-3);
    checks.below("hinge and roller: thrust over load",
                 beam.at("hinge_force_x[N]") / load,
                 1e-6);
    checks.below("hinge and roller: balance",
                 (beam.at("hinge_force_z[N]") + beam.at("roller_force_z[N]")) /
                     load -
                   1,
                 1e-8);
  }

  /** A rigid fiber slides across another one by 2 radii. */
  void
  check_dissipation(Checks &checks)
  {
    const double friction = .3, sliding = 2 * radius,
                 elastic_slip = .05 * radius;
    const auto rows           = run_load(
      "set Drives = lower, upper\nsubsection Load\nset End = 2\n"
                "set First step = 0.25\nset Largest step = 0.25\nend\n"
                "subsection Contact\nset Friction coefficient = " +
      number(friction) + "\nset Line stiffness = 20\nend\n" +
      fibers("-0.3 0 0, 0.3 0 0; 0 -0.3 0.02, 0 0.3 0.02", 6) +
      drive("lower", "set Ends = 0 whole\n") +
      drive("upper",
            "set Ends = 1 whole\nset Translation = " + number(sliding) +
              "*max(0, t-1); 0; -0.0005*min(t, 1)\n"));
    double before = 0, least = 0, work = 0, sliding_work = 0;
    for (const Row &row : rows)
      {
        const double lost = row.at("dissipation[N.mm]");
        least             = std::min(least, lost - before);
        before            = lost;
        if (row.at("t") > 1)
          {
            work += row.at("upper_force_x[N]") * .25 * sliding;
            sliding_work +=
              friction * row.at("contact_force_sum[N]") * .25 * sliding;
          }
      }
    const double limit = friction * rows.back().at("contact_force_sum[N]");
    checks.equal("least dissipation of an increment", least, 0);
    checks.below("force that slides",
                 rows.back().at("upper_force_x[N]") / limit - 1,
                 .01);
    checks.below("dissipation by sliding over mu N times its way",
                 before / (sliding_work - limit * elastic_slip) - 1,
                 .01);
    checks.below("work of sliding against what is lost and stored",
                 work / (before + limit * elastic_slip * 2 / 3) - 1,
                 .05);
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::ofstream                            output("output");
  Checks                                   checks(output);
  check_turns(checks);
  check_center(checks);
  check_line_loads(checks);
  check_dissipation(checks);
}
