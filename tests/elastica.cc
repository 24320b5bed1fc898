// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// Large bending through stage "load": the elastica of prm/cantilever.prm
// (case A2 of the reference cases, after Mattiasson 1981), the same rolled up
// to a circle by a moment (case A1), and the bend of 45 degrees with a curved
// reference (case A3) against its ordinary differential equation, eight
// elements each. The clamp's reaction balances the load.

#include <fiberloom/fabric/fabric_parameters.h>

#include <fiberloom/stages/load_settings.h>

#include <deal.II/base/mpi.h>

#include <Eigen/LU>

#include <fstream>
#include <iomanip>
#include <sstream>

#include "checks.h"
#include "run_stages.h"
#include "sample_fibers.h"

using namespace fiberloom;

namespace
{
  struct Elastica
  {
    double load, deflection, shortening, angle; // over P L^2/(E I), L
  };

  constexpr std::array<Elastica, 4> exact{
    {{1, .30172077, .05643324, .46135195},
     {2, .49345748, .16064172, .78174983},
     {5, .71379152, .38762836, 1.2153681},
     {10, .81060902, .5549956, 1.4302855}}};

  /** Largest error of the four at each load, over the exact value. */
  std::array<double, 4>
  elastica_errors(const unsigned int n_elements, double &imbalance)
  {
    Parameters parameters =
      Parameters::parse(SOURCE_DIR "/../prm/cantilever.prm",
                        {"Fibers/Elements per fiber=" +
                         std::to_string(n_elements)});
    resolve_fabric(parameters);
    const double L = 8, r = .008, EI = 73000 * M_PI * std::pow(r, 4) / 4;

    std::array<double, 4> errors{{1, 1, 1, 1}};
    imbalance = 0;
    run_stages(parameters,
               build_fiber_set(parameters),
               [&](const IncrementReport &report) {
                 const auto    tip = report.state.q.tail<9>();
                 const Vector3 axis =
                   Vector3(tip.segment<3>(3)).cross(Vector3(tip.segment<3>(6)));
                 const double P = 10 * report.state.load * EI / (L * L);
                 for (unsigned int i = 0; i < exact.size(); ++i)
                   if (std::abs(10 * report.state.load - exact[i].load) < 1e-6)
                     errors[i] = std::max(
                       {std::abs(tip[2] / L / exact[i].deflection - 1),
                        std::abs((1 - tip[0] / L) / exact[i].shortening - 1),
                        std::abs(std::atan2(axis[2], axis[0]) / exact[i].angle -
                                 1)});
                 BodyVector clamp;
                 clamp << 0, 0, -P,
                   Vector3(tip.head<3>()).cross(Vector3(0, 0, -P));
                 BodyVector wrong = report.reactions[0] - clamp;
                 wrong.tail<3>() /= L;
                 imbalance = std::max(imbalance, wrong.norm() / P);
               });
    return errors;
  }

  /**
   * Case A1: a moment at the tip rolls the fiber up to a full circle, in its
   * plane, since out of it the dead moment is unstable. Distance of the tip
   * from the clamp over the length.
   */
  double
  opening_of_circle()
  {
    const double       L = 8, EI = 73000 * M_PI * std::pow(.008, 4) / 4;
    std::ostringstream moment;
    moment << std::setprecision(12) << "0; -" << 2 * M_PI * EI / L << "*t; 0";
    Parameters parameters =
      Parameters::parse(SOURCE_DIR "/../prm/cantilever.prm",
                        {"Drive tip/Free=x z ry",
                         "Drive tip/Force=0; 0; 0",
                         "Drive tip/Moment=" + moment.str()});
    resolve_fabric(parameters);
    double opening = 1;
    run_stages(parameters,
               build_fiber_set(parameters),
               [&](const IncrementReport &report) {
                 if (report.last)
                   opening = report.state.q.tail<9>().head<3>().norm() / L;
               });
    return opening;
  }

  /**
   * Tip of the bend by shooting for the moment at the clamp: Simo's rod with
   * the strains n/(EA, GA, GA) and m/(GJ, EI, EI), clamped along x, curved
   * towards y, load along z; fourth-order Runge-Kutta.
   */
  class BendEquation
  {
  public:
    static constexpr double R = 100, E = 1e7, A = 1, G = 5e6;

    explicit BendEquation(const double load,
                          const double I = A * A / (4 * M_PI))
      : I(I)
      , force(0, 0, load)
    {
      for (unsigned int i = 0; i < 30; ++i)
        {
          const Vector3 rest = moment_at_tip(start_moment);
          Matrix3       jacobian;
          const double  h = 1e-4 * E * I / R;
          for (unsigned int d = 0; d < 3; ++d)
            jacobian.col(d) =
              (moment_at_tip(start_moment + h * Vector3::Unit(d)) - rest) / h;
          start_moment -= jacobian.inverse() * rest;
        }
      moment_at_tip(start_moment);
    }

    const Vector3 &
    tip() const
    {
      return last.position;
    }

  private:
    struct Rod
    {
      Vector3 position = Vector3::Zero();
      Matrix3 frame    = Matrix3::Identity(); // tangent first
      Vector3 moment   = Vector3::Zero();
    };

    Rod
    derivative(const Rod &rod) const
    {
      const Vector3 n = rod.frame.transpose() * force;
      const Vector3 m = rod.frame.transpose() * rod.moment;
      const Vector3 k(m[0] / (2 * G * I),
                      m[1] / (E * I),
                      m[2] / (E * I) + 1 / R);
      Matrix3       skew;
      skew << 0, -k[2], k[1], k[2], 0, -k[0], -k[1], k[0], 0;
      Rod slope;
      slope.position =
        rod.frame * Vector3(1 + n[0] / (E * A), n[1] / (G * A), n[2] / (G * A));
      slope.frame  = rod.frame * skew;
      slope.moment = -slope.position.cross(force);
      return slope;
    }

    static Rod
    moved(const Rod &rod, const Rod &slope, const double step)
    {
      return {rod.position + step * slope.position,
              rod.frame + step * slope.frame,
              rod.moment + step * slope.moment};
    }

    Vector3
    moment_at_tip(const Vector3 &at_clamp)
    {
      constexpr unsigned int n = 200;
      const double           h = R * M_PI / 4 / n;
      last                     = Rod();
      last.moment              = at_clamp;
      for (unsigned int i = 0; i < n; ++i)
        {
          const Rod a = derivative(last);
          const Rod b = derivative(moved(last, a, h / 2));
          const Rod c = derivative(moved(last, b, h / 2));
          const Rod d = derivative(moved(last, c, h));
          last = moved(moved(moved(moved(last, a, h / 6), b, h / 3), c, h / 3),
                       d,
                       h / 6);
        }
      return last.moment;
    }

    const double  I;
    const Vector3 force;
    Vector3       start_moment = Vector3::Zero();
    Rod           last;
  };

  /** Largest error of the tip's place over the radius of the bend. */
  double
  bend_error(const unsigned int n_elements)
  {
    using Bend       = BendEquation;
    const double arc = M_PI / 4, radius = std::sqrt(Bend::A / M_PI);
    Fiber        fiber = curved_fiber(
      [&](const double t) {
        return Vector3(Bend::R * std::sin(arc * t),
                       Bend::R * (1 - std::cos(arc * t)),
                       0);
      },
      n_elements,
      Vector3::UnitZ(),
      0.);
    fiber.radius        = radius;
    fiber.young_modulus = Bend::E;

    Parameters parameters;
    parameters.stages           = {"load"};
    parameters.fibers.polylines = "a bend";
    DriveParameters clamp, tip;
    clamp.name        = "clamp";
    clamp.ends        = "0 start";
    tip.name          = "tip";
    tip.ends          = "0 end";
    tip.free          = "x y z rx ry rz";
    tip.force         = "0; 0; 600*t";
    parameters.drives = {clamp, tip};
    parameters.resolve();
    auto &load      = parameters.stage_settings.get<LoadSettings>();
    load.first_step = load.largest_step = .25;

    double       error   = 0;
    unsigned int n_loads = 0;
    run_stages(
      parameters, loose_fibers({fiber}), [&](const IncrementReport &report) {
        if (report.state.load < .4)
          return;
        const Vector3 exact_tip = BendEquation(600 * report.state.load).tip();
        error =
          std::max(error,
                   (report.state.q.tail<9>().head<3>() - exact_tip).norm() /
                     Bend::R);
        ++n_loads;
      });
    return n_loads == 3 ? error : 1;
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::ofstream                            output("output");
  Checks                                   checks(output);

  double     imbalance;
  const auto coarse = elastica_errors(4, imbalance);
  const auto fine   = elastica_errors(8, imbalance);
  for (unsigned int i = 0; i < exact.size(); ++i)
    checks.below("elastica, P L^2/(E I) = " +
                   std::to_string(int(exact[i].load)),
                 fine[i],
                 1e-3);
  checks.below("clamp against tip", imbalance, 1e-6);
  checks.above("order of convergence", std::log2(coarse[3] / fine[3]), 2);

  // Published for a square section with the polar moment for torsion.
  checks.below("bend: the equation with a square section",
               (BendEquation(600, 1. / 12).tip() -
                Vector3(47.15044, 15.68480, 53.47486))
                 .norm(),
               2e-5);
  checks.below("bend at 300, 450, 600", bend_error(8), 1e-3);
  checks.below("full circle by a moment", opening_of_circle(), 2e-3);
}
