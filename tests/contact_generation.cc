// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// Where contact elements are put, and with which normals; each check names what
// would go wrong otherwise. Radii are 1.

#include <fiberloom/base/parameters.h>

#include <fiberloom/fabric/fabric_parameters.h>
#include <fiberloom/fabric/superimposition.h>

#include <fiberloom/contact/contact_generator.h>
#include <fiberloom/contact/contact_law.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <utility>

#include "checks.h"
#include "contact_model.h"

using namespace fiberloom;

namespace
{
  // Held side by side at one end, from where they part, as at the end of a tow:
  // their tangents are perpendicular to a plane in which they overlap.
  void
  check_parting(Checks &checks)
  {
    const Vector3 begin(0, 1, std::sqrt(3.));
    double        deepest = 0;
    for (double angle = .05; angle < 1.5; angle += .05)
      {
        const Vector3 away(std::cos(angle), 0, std::sin(angle));
        ContactModel  model({straight_fiber({0, 0, 0}, {20, 0, 0}, 4),
                             straight_fiber(begin, begin + 20 * away, 4)});
        for (const ContactElement &contact : model.generate())
          deepest = std::max(deepest, -contact.gap);
      }
    checks.below("fibers that part from their ends: penetration",
                 deepest,
                 1e-12);
  }

  void
  check_crossing(Checks &checks)
  {
    ContactModel model(
      {along_x(), straight_fiber({3, -20, 1.9}, {3, 20, 1.9}, 4)});
    auto contacts = model.generate();
    checks.equal("crossing: contacts", contacts.size(), 1);
    checks.equal("crossing: on the first", model.u(contacts[0], 0), 2.3);
    checks.equal("crossing: on the second", model.u(contacts[0], 1), 2);
    checks.equal("crossing: normal", -contacts[0].normal.z(), 1);
    checks.equal("crossing: gap", contacts[0].gap, -.1);

    // A direction from centre to centre would turn by the slide over 1.9.
    model.shift(1, {.5, 0, 0});
    model.generator.update(contacts, model.q, model.q, standard, model.state);
    checks.below("normal does not turn as fibers slide",
                 contacts[0].normal.cross(Vector3::UnitZ()).norm(),
                 1e-12);
    checks.equal("nor does the gap open", contacts[0].gap, -.1);

    // Pushed through each other the fibers still know their sides.
    model.shift(1, {0, 0, -2.2});
    contacts = model.generate();
    checks.equal("the side is kept", -contacts[0].normal.z(), 1);
    checks.equal("with the whole penetration", contacts[0].gap, -2.3);
    model.state = ContactState();
    checks.equal("without history it is lost",
                 model.generate()[0].normal.z(),
                 1);
  }

  void
  check_parallel(Checks &checks)
  {
    ContactModel model({along_x(), along_x(1.95)});
    model.shift(1, {.37, 0, 0});
    const auto contacts = model.generate();
    checks.equal("parallel: contacts", contacts.size(), 8);
    checks.equal("parallel: zones", model.state.zones.size(), 1);
    model.shift(1, {.8, 0, 0});
    const auto after = model.generate();
    double     wrong = 0;
    for (unsigned int k = 0; k < 8; ++k)
      wrong =
        std::max({wrong,
                  std::abs(model.u(contacts[k], 0) - (k + .5) / 2),
                  std::abs(model.u(contacts[k], 1) - ((k + .5) / 2 - .037)),
                  std::abs(model.u(after[k], 0) - (k + .5) / 2),
                  std::abs(model.u(after[k], 1) - ((k + .5) / 2 - .117)),
                  std::abs(after[k].normal.z() + 1)});
    checks.below("stations stay on the first fiber as the second slides",
                 wrong,
                 1e-9);
  }

  /**
   * Two arcs that are bent around each other touch on a length, and on both
   * sides of their mutual closest point once they are bent more than they
   * drift apart, though they meet at an angle. Near a right one they cross.
   */
  void
  check_bent_around(Checks &checks)
  {
    const auto arcs = [](const double cosine, const double radius) {
      const double sine = std::sqrt(1 - cosine * cosine);
      const auto   arc  = [&](const double side, const Vector3 &along) {
        return curved_fiber(
          [=](const double t) -> Vector3 {
            const double angle = 16 / radius * (t - .5);
            return radius * std::sin(angle) * along +
                   side * (.97 - radius * (1 - std::cos(angle))) *
                     Vector3::UnitZ();
          },
          8,
          Vector3(-along.y(), along.x(), 0));
      };
      return ContactModel(
        {arc(1, Vector3::UnitX()), arc(-1, {cosine, sine, 0})});
    };
    const auto check =
      [&](const std::string &what, ContactModel &model, const bool crossing) {
        model.generate();
        checks.that(what,
                    model.state.zones.size() == 1 &&
                      model.state.zones[0].crossing == crossing);
      };

    // Drift over that of straight fibers: 1 - 1.94/radius/(1 - cosine).
    ContactModel model = arcs(.6, 15);
    check("arcs that drift apart cross", model, true);
    model.q = arcs(.6, 9.6).q;
    check("they still do where half of the drift is left", model, true);
    model.q = arcs(.6, 8).q;
    check("with less they lie along each other", model, false);
    model.q = arcs(.6, 9.6).q;
    check("and still do with half of it", model, false);
    model.q = arcs(.6, 15).q;
    check("until they drift apart again", model, true);
    ContactModel nearly_square = arcs(.2, 4.3);
    check("near a right angle they cross with less, too", nearly_square, true);
  }

  /**
   * As a fiber's end slides along another one, contact goes with the length
   * that they share; no station appears or vanishes with force on it.
   */
  void
  check_ends(Checks &checks)
  {
    ContactModel model(
      {along_x(), straight_fiber({0, 0, 1.9}, {20, 0, 1.9}, 2)});
    const double step    = .1;
    double       largest = 0, before = 0, error = 0;
    for (unsigned int i = 0; i <= 150; ++i)
      {
        double length = 0;
        for (const ContactElement &contact : model.generate())
          length += contact.length;
        const double shared = 20 - i * step;
        error               = std::max(error, std::abs(length - shared));
        if (i > 0)
          largest = std::max(largest, std::abs(length - before));
        before = length;
        model.shift(1, {step, 0, 0});
      }
    checks.below("shared length, over the step between",
                 std::abs(largest / step - 1),
                 1e-6);
    checks.below("length of the contacts", error, 1e-9);
  }

  /** The wavy fiber's point nearest to @p point by its centre line alone. */
  double
  nearest_on_line(const ContactModel &model,
                  const Vector3      &point,
                  const double        around)
  {
    double nearest = 0, least = 1e9;
    for (double u = around - .5; u < around + .5; u += 2e-4)
      {
        const double distance =
          (model.mesh.section(model.q, model.mesh.locate(0, u)).center - point)
            .squaredNorm();
        if (distance < least)
          {
            least   = distance;
            nearest = u;
          }
      }
    return nearest;
  }

  /**
   * The centre line is only continuous: over an element's end its nearest
   * point hops, or waits there. The section's tangent has no kink.
   */
  void
  check_kinks(Checks &checks)
  {
    const auto wave = [](const double t) {
      return Vector3(60 * t, 0, 2.5 * std::sin(4 * M_PI * t));
    };
    double kink = 0;
    for (const double side : {1., -1.})
      {
        // Four elements a wave length: node 6 is an element end, without slope.
        ContactModel model({curved_fiber(wave, 8, Vector3::UnitY()),
                            straight_fiber({0, -20, 0}, {0, 20, 0}, 4)});
        const double end = 3, x = 60 * end / 8;
        const auto   tangent = [&](const double u) {
          return model.mesh.section(model.q, model.mesh.locate(0, u))
            .center_derivative.normalized();
        };
        kink =
          std::max(kink, tangent(end - 1e-9).cross(tangent(end + 1e-9)).norm());

        double before = -1, before_on_line = -1;
        double largest = 0, least = 1e9, largest_on_line = 0,
               least_on_line = 1e9;
        const double step    = .05;
        model.shift(1, Vector3(x - 1, 0, wave(end / 8).z() + 1.9 * side));
        const Vector3 start =
          model.q.segment<3>(9 * (model.mesh.lines()[1].first_node + 4));
        for (unsigned int i = 0; i <= 40; ++i)
          {
            const auto contacts = model.generate();
            if (contacts.size() != 1)
              {
                checks.that("one contact on the wavy fiber", false);
                return;
              }
            const double u = model.u(contacts[0], 0);
            const double on_line =
              nearest_on_line(model, start + Vector3(i * step, 0, 0), end);
            if (i > 0)
              {
                largest = std::max(largest, u - before);
                least   = std::min(least, u - before);
                largest_on_line =
                  std::max(largest_on_line, on_line - before_on_line);
                least_on_line =
                  std::min(least_on_line, on_line - before_on_line);
              }
            before         = u;
            before_on_line = on_line;
            model.shift(1, Vector3(step, 0, 0));
          }
        std::cout << "per step of motion, sections " << least * 7.5 / step
                  << " to " << largest * 7.5 / step << ", line "
                  << least_on_line * 7.5 / step << " to "
                  << largest_on_line * 7.5 / step << std::endl;
        const std::string name = side > 0 ? "above" : "below";
        checks.below("closest point, largest over mean step, " + name,
                     largest * 7.5 / step,
                     1.6);
        checks.above("least over mean step, " + name, least * 7.5 / step, .5);
        checks.that("by the centre line it hops or waits, " + name,
                    largest_on_line * 7.5 / step > 2 ||
                      least_on_line * 7.5 / step < .1);
      }
    checks.above("kink of the centre line", kink, .05);
  }

  void
  check_self_contact(Checks &checks)
  {
    const auto helix = [](const double t) {
      const double angle = 4 * M_PI * t;
      return Vector3(10 * std::cos(angle), 10 * std::sin(angle), 3.9 * t);
    };
    ContactModel loop({curved_fiber(helix, 24, Vector3::UnitZ())});
    const double turn  = std::hypot(20 * M_PI, 1.95);
    double       wrong = 0, length = 0;
    for (const ContactElement &contact : loop.generate())
      {
        length += contact.length;
        // The last station fades where the fiber ends.
        wrong =
          std::max({wrong,
                    contact.length / (turn / 24) *
                      std::abs(loop.u(contact, 1) - loop.u(contact, 0) - 12),
                    std::abs(std::abs(contact.normal.z()) - 1)});
      }
    checks.below("two turns: length of contact over one turn, less one",
                 length / turn - 1,
                 .01);
    checks.below("one turn apart, above each other", wrong, .02);

    ContactModel alone({along_x()});
    checks.equal("straight fiber: contacts", alone.generate().size(), 0);
  }

  /** Of warp and fill each, of radius 1 at a pitch of 30. */
  FiberSet
  flat_fabric(const unsigned int n_tows, const unsigned int n_fibers)
  {
    Parameters parameters;
    for (TowParameters *tows :
         {&parameters.fabric.warp, &parameters.fabric.fill})
      {
        tows->tows         = n_tows;
        tows->fibers       = n_fibers;
        tows->fiber_radius = 1;
        tows->tow_spacing  = 30;
      }
    parameters.resolve();
    resolve_fabric(parameters);
    return build_fabric(parameters);
  }

  /**
   * Rigid straight cylinders at an angle, from crossing to parallel: the force
   * of a line penalty on the intermediate geometry,
   * k d cot(a/2) (D asinh(x0/d) - x0) with d = D - p and x0^2 = D^2 - d^2,
   * whichever class the contact has, at any place of the stations.
   */
  void
  check_angles(Checks &checks)
  {
    const double D = 2, p = .02, d = D - p, x0 = std::sqrt(D * D - d * d);
    const double exact_factor = d * (D * std::asinh(x0 / d) - x0);
    double       error = 0, jump = 0, previous = 0;
    for (double angle = 90; angle > .9; angle /= 1.02)
      {
        const double  half = .5 * angle * M_PI / 180;
        const Vector3 along(std::cos(half), std::sin(half), 0),
          other(std::cos(half), -std::sin(half), 0);
        const Vector3 shift(.37 * angle / 90, 0, d);
        ContactModel  model(
          {straight_fiber(-200 * along, 200 * along, 20),
            straight_fiber(shift - 200 * other, shift + 200 * other, 20)},
          1.);
        double force = 0;
        for (const ContactElement &contact : model.generate())
          force -= contact.normal_force * contact.normal.z();
        const double ratio = force * std::tan(half) / exact_factor;
        error              = std::max(error, std::abs(ratio - 1));
        jump = previous == 0 ? 0 : std::max(jump, std::abs(ratio - previous));
        previous = ratio;
      }
    checks.below("force at any angle", error, .02);
    checks.below("jump of the force over one degree in 50", jump, .02);
  }

  int
  order(const ContactModel &model, const ContactElement &contact)
  {
    return superimposition(model.fibers, contact.fibers[0], contact.fibers[1]);
  }

  /**
   * Tows of a flat fabric overlap wholly: by distance one could tell neither
   * which fibers meet nor on which side.
   */
  void
  check_weaving(Checks &checks)
  {
    ContactModel model(flat_fabric(2, 3));
    ContactRule  from_above;
    from_above.from_above      = true;
    from_above.allowed_overlap = .05;

    unsigned int n_woven = 0, n_others = 0;
    double       wrong = 0;
    for (const ContactElement &contact : model.generate(from_above))
      {
        if (order(model, contact) == 0)
          {
            ++n_others;
            continue;
          }
        ++n_woven;
        const Vector3 apart =
          model.mesh.section(model.q, contact.points[0]).center -
          model.mesh.section(model.q, contact.points[1]).center;
        wrong = std::max(
          {wrong,
           apart.head<2>().norm(),
           (contact.normal - order(model, contact) * Vector3::UnitZ()).norm(),
           std::abs(contact.gap - (contact.normal.dot(apart) - 2 + .05))});
      }
    checks.equal("woven: each pair of crossing fibers meets", n_woven, 36);
    checks.above("woven: fibers of a tow meet, too", n_others, 1);
    checks.below("woven: at their crossing, in the order of the weave",
                 wrong,
                 1e-9);

    for (unsigned int f = 0; f < model.fibers.fibers.size(); ++f)
      if (model.fibers.tows[model.fibers.fibers[f].tow].family ==
          Tow::Family::warp)
        model.shift(f, {0, 0, 9});
    checks.equal("woven: out of order with the warp above all",
                 model.generator.crossings_out_of_order(model.q),
                 18);
  }

  /**
   * When weaving ends, crossings are found by distance instead of from above.
   * Between inclined fibers a vertical gap would turn into a penetration then.
   */
  void
  check_change_of_search(Checks &checks)
  {
    ContactModel model(flat_fabric(1, 1));
    const int    side = superimposition(model.fibers, 0, 1);
    const auto  &line = model.mesh.lines()[0];
    for (unsigned int n = 0; n < line.n_nodes(); ++n)
      {
        auto node            = model.q.segment<9>(9 * (line.first_node + n));
        node[2]              = 2.1 * side + .4 * node[0];
        const Vector3 across = node.segment<3>(3);
        node.segment<3>(6)   = Vector3(1, 0, .4).normalized().cross(across);
      }

    ContactRule from_above;
    from_above.from_above = true;
    const double gap      = 2.1 / std::sqrt(1.16) - 2;
    checks.equal("gap of inclined fibers, found from above",
                 model.generate(from_above).at(0).gap,
                 gap);
    checks.equal("and by distance", model.generate(standard).at(0).gap, gap);
  }

  /** Ranks that share the pairs of fibers have what one finds by itself. */
  void
  check_sharing(Checks &checks)
  {
    ContactRule from_above;
    from_above.from_above = true;
    for (const ContactRule &rule : {standard, from_above})
      {
        ContactModel      model(flat_fabric(3, 2));
        ContactGenerator  alone(model.fibers,
                               model.mesh,
                               model.parameters,
                               MPI_COMM_SELF);
        ContactState      state;
        const auto        shared = model.generate(rule);
        const auto        found = alone.generate(model.q, model.q, rule, state);
        const std::string which =
          rule.from_above ? ", from above" : ", by distance";
        checks.above("contacts" + which, found.size(), 10);
        checks.equal("contacts, shared" + which,
                     double(shared.size()) - found.size(),
                     0);
        checks.equal("zones, shared" + which,
                     double(model.state.zones.size()) - state.zones.size(),
                     0);
        double difference = 0;
        for (unsigned int c = 0; c < found.size(); ++c)
          difference += (shared.at(c).normal - found[c].normal).norm() +
                        std::abs(shared[c].gap - found[c].gap) +
                        std::abs(model.mesh.parameter(shared[c].points[0]) -
                                 model.mesh.parameter(found[c].points[0])) +
                        std::abs(double(shared[c].zone) - found[c].zone);
        for (unsigned int z = 0; z < state.zones.size(); ++z)
          {
            const ContactZone &a = model.state.zones.at(z), &b = state.zones[z];
            difference += (a.stiffness != b.stiffness) +
                          (a.fibers != b.fibers) + (a.range != b.range) +
                          (a.crossing != b.crossing) + (a.side != b.side) +
                          (a.divided != b.divided);
          }
        checks.equal("difference" + which, difference, 0);
      }
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::ofstream                            output;
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    output.open("output");
  Checks checks(output);
  check_crossing(checks);
  check_parting(checks);
  check_parallel(checks);
  check_bent_around(checks);
  check_ends(checks);
  check_kinks(checks);
  check_self_contact(checks);
  check_angles(checks);
  check_weaving(checks);
  check_change_of_search(checks);
  check_sharing(checks);
}
