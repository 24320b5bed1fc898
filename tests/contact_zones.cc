// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// What contact zones remember from one generation to the next; each check names
// what would go wrong otherwise. Radii are 1.

#include <fiberloom/contact/contact_generator.h>
#include <fiberloom/contact/contact_law.h>
#include <fiberloom/contact/proximity_zones.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "checks.h"
#include "contact_model.h"

using namespace fiberloom;

namespace
{
  /** The second fiber at an angle to the first, above its middle. */
  void
  set_angle(ContactModel &model, const double cosine)
  {
    const Vector3 along(cosine, std::sqrt(1 - cosine * cosine), 0);
    const auto   &line = model.mesh.lines()[1];
    for (unsigned int n = 0; n < line.n_nodes(); ++n)
      model.q.segment<9>(9 * (line.first_node + n))
        << (5. * n - 20) * along + Vector3(0, 0, 1.9),
        Vector3::UnitZ(), along.cross(Vector3::UnitZ());
  }

  void
  check_hysteresis(Checks &checks)
  {
    ContactModel model({along_x(), along_x(1.9)});
    const std::array<std::pair<double, bool>, 6> path{{{.5, true},
                                                       {.92, true},
                                                       {.96, false},
                                                       {.88, false},
                                                       {.84, true},
                                                       {.92, true}}};
    for (const auto &[cosine, crossing] : path)
      {
        set_angle(model, cosine);
        const auto contacts = model.generate();
        checks.that("class at " + std::to_string(cosine) + " with history",
                    model.state.zones.size() == 1 &&
                      model.state.zones[0].crossing == crossing &&
                      (contacts.size() == 1) == crossing);
      }
    for (const auto &[cosine, crossing] :
         {std::make_pair(.92, false), std::make_pair(.88, true)})
      {
        model.state = ContactState();
        set_angle(model, cosine);
        model.generate();
        checks.that("class at " + std::to_string(cosine) + " without",
                    model.state.zones[0].crossing == crossing);
      }
  }

  /** The most stations in a cell of the only zone. */
  unsigned int
  stations_in(const ContactState &state)
  {
    unsigned int most = 1;
    for (const auto &cell : state.zones.at(0).divided)
      most = std::max(most, cell.second);
    return most;
  }

  unsigned int
  stations_of(ContactModel &model)
  {
    model.generate();
    return stations_in(model.state);
  }

  /**
   * Cells of parallel fibers keep their number of stations until a quarter
   * of the overlap would do with fewer; without that, stations come and go,
   * with force on them, as an angle hardly moves.
   */
  void
  check_stations_stay(Checks &checks)
  {
    ContactModel kept({along_x(), along_x(1.9)});
    const double first    = .3; // rad; within the class of parallel fibers
    const auto   count_at = [&](const double angle, const bool history) {
      set_angle(kept, std::cos(angle));
      if (history)
        return stations_of(kept);
      const ContactState state = std::exchange(kept.state, ContactState());
      const unsigned int parts = stations_of(kept);
      kept.state               = state;
      return parts;
    };
    const unsigned int most = count_at(first, true);
    checks.above("stations in a cell at an angle", most, 1.5);

    double without = 0, with = 0, angle = first;
    for (; with == 0 && angle > .01; angle /= 1.01)
      {
        if (without == 0 && count_at(angle, false) < most)
          without = angle;
        if (count_at(angle, true) < most)
          with = angle;
      }
    checks.below("angle at which stations go, over that without history",
                 std::abs(with / without - .25),
                 .01);
    checks.equal("stations between, on the way back",
                 count_at(.5 * (with + without), true),
                 most / 2);
    checks.equal("they come back where they are needed",
                 count_at(1.02 * without, true),
                 most);
  }

  /** Fibers turn along each other once a cell is divided: none of its stations
   * goes before the next increment begins. */
  void
  check_increment(Checks &checks)
  {
    ContactModel model({along_x(), along_x(1.9)});
    set_angle(model, std::cos(.3));
    const DofVector    begin = model.q;
    const unsigned int most  = stations_of(model);
    const auto         count = [&](const DofVector &q_before) {
      ContactState state = model.state;
      model.generator.generate(model.q, q_before, standard, state);
      return stations_in(state);
    };
    set_angle(model, std::cos(.001));
    checks.equal("stations within an increment", count(begin), most);
    checks.equal("where one begins", count(model.q), 1);
  }

  void
  check_inheritance(Checks &checks)
  {
    ContactModel model({along_x(), along_x(1.95)});
    const auto   lift_middle = [&](const double height) {
      const auto &line = model.mesh.lines()[1];
      for (unsigned int n = 3; n <= 5; ++n)
        model.q[9 * (line.first_node + n) + 2] = 1.95 + height;
    };
    model.generate();
    checks.equal("stiffness of half an element at first, over E r",
                 5 * model.state.zones[0].stiffness.at(0).second,
                 model.parameters.initial_stiffness);
    model.state.zones[0].stiffness.at(0).second = 7;
    lift_middle(4);
    auto contacts = model.generate();
    checks.equal("zones after a split", model.state.zones.size(), 2);
    double wrong = 0;
    for (const ContactElement &contact : contacts)
      wrong = std::max(wrong, std::abs(contact.stiffness - 7));
    checks.below("each inherits the stiffness", wrong, 1e-12);

    model.state.zones[0].stiffness.at(0).second = 9;
    const std::vector<std::pair<int, unsigned int>> divided{{0, 4}, {7, 2}};
    for (unsigned int z = 0; z < 2; ++z)
      model.state.zones[z].divided = {divided[z]};
    const DofVector apart = model.q;
    lift_middle(0);
    ContactState merged = model.state;
    model.generator.generate(model.q, apart, standard, merged);
    checks.that("divided cells of both after the merge",
                merged.zones.at(0).divided == divided);
    for (const std::string &when : {"after the merge", "once more"})
      {
        contacts = model.generate();
        checks.equal("zones " + when, model.state.zones.size(), 1);
        const auto &parts = model.state.zones[0].stiffness;
        checks.equal("parts of its stiffness " + when, parts.size(), 2);
        const double n = model.mesh.lines()[0].n_elements;
        checks.below("between the two " + when,
                     std::abs(parts[0].first - n / 2),
                     1 / model.parameters.stations_per_element);
        wrong = 0;
        for (const ContactElement &contact : contacts)
          wrong = std::max(wrong,
                           std::abs(contact.stiffness -
                                    (model.mesh.parameter(contact.points[0]) <
                                         parts[0].first ?
                                       9 :
                                       7)));
        checks.equal("stations keep theirs " + when, wrong, 0);
      }
  }

  /** Parts of predecessors that overlap, touch, lie apart or within others. */
  void
  check_inherited_parts(Checks &checks)
  {
    const auto zone = [](const std::array<double, 2>                  &range,
                         const std::vector<std::pair<double, double>> &parts) {
      ContactZone zone;
      zone.fibers    = {{0, 1}};
      zone.range     = {{range, range}};
      zone.stiffness = parts;
      return zone;
    };
    const std::vector<ContactZone> zones{zone({{0, 4}}, {{2, 5}, {4, 6}}),
                                         zone({{7, 11}}, {{11, 7}}),
                                         zone({{8, 9}}, {{9, 8}}),
                                         zone({{10, 14}}, {{14, 9}})};
    const auto inherited = [&](const std::array<double, 2> &range,
                               const double                 shift) {
      std::array<double, 2> there = range;
      for (double &u : there)
        u += shift;
      return inherited_stiffness(
        find_predecessors(zones, {{0, 1}}, {{there, there}}), range, .5, shift);
    };
    using Parts = std::vector<std::pair<double, double>>;
    const std::vector<std::tuple<std::string, std::array<double, 2>, Parts>>
      cases{{"all", {{0, 14}}, {{2, 5}, {5.5, 6}, {10.5, 7}, {14, 9}}},
            {"a longer zone", {{0, 6}}, {{2, 5}, {6, 6}}},
            {"a shorter zone", {{2.5, 3.5}}, {{3.5, 6}}},
            {"two of them", {{3, 8}}, {{5.5, 6}, {8, 7}}},
            {"a point", {{1, 1}}, {{1, 5}}},
            {"next to one", {{4.2, 5}}, {{5, 6}}}};
    for (const auto &[name, range, parts] : cases)
      for (const double shift : {0, 3})
        {
          auto moved = range;
          auto ends  = parts;
          for (double &u : moved)
            u -= shift;
          for (auto &part : ends)
            part.first -= shift;
          checks.that("parts inherited by " + name + ", shifted by " +
                        std::to_string(int(shift)),
                      inherited(moved, shift) == ends);
        }
    checks.that("no predecessor",
                find_predecessors(zones, {{0, 1}}, {{{{20, 21}}, {{20, 21}}}})
                  .all.empty());
  }

  /** Reversible slip goes to the station nearby, on its new tangent plane. */
  void
  check_history(Checks &checks)
  {
    ContactModel model(
      {along_x(), straight_fiber({3, -20, 1.9}, {3, 20, 1.9}, 4)});
    const DofVector before = model.q;
    model.shift(1, {.01, 0, 0});
    ContactRule friction = standard;
    friction.friction    = true;
    for (const double away : {.1, .6})
      {
        model.state.history = {
          {{{0, 1}}, {{2.3 + away, 2}}, Vector3(.03, .02, .01)}};
        const auto contact =
          model.generator.generate(model.q, before, friction, model.state)
            .at(0);
        const Vector3 expected(away < .5 ? .03 : 0, away < .5 ? .02 : 0, 0);
        checks.below("slip inherited from " + std::to_string(away) +
                       " elements away",
                     (contact.slip_before - expected).norm(),
                     1e-12);
        checks.equal("limit over force",
                     contact.friction_limit / contact.normal_force,
                     model.parameters.friction_coefficient);
        const Vector3 slip =
          particle_separation(contact, section_pair(contact, model.q)) -
          contact.separation_before;
        checks.below("slip of the increment",
                     (slip - Vector3(-.01, 0, 0)).norm(),
                     1e-12);
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
  check_hysteresis(checks);
  check_stations_stay(checks);
  check_increment(checks);
  check_inheritance(checks);
  check_inherited_parts(checks);
  check_history(checks);
}
