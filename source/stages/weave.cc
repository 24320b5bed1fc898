// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/parameter_catalogue.h>
#include <fiberloom/base/parameters.h>

#include <fiberloom/stages/weave.h>

#include <algorithm>

namespace fiberloom
{
  namespace
  {
    // Over the radius, the largest by which weaves have been compared.
    constexpr double preview_step = .7;
  } // namespace



  void
  WeaveSettings::declare(ParameterCatalogue &catalogue)
  {
    catalogue.enter_section("Weaving");
    catalogue.add("Path",
                  path,
                  "automatic weaves in one increment, without friction until "
                  "the fabric is at rest, and falls back to nested, which "
                  "takes every step to equilibrium with friction.");
    catalogue.add("Step",
                  step,
                  "By how much the allowed overlap of crossing tows shrinks "
                  "in a step, over the fiber radius.",
                  Allowed::above(0));
    catalogue.add("Fast iterations per step",
                  fast_iterations_per_step,
                  "Newton iterations of each step of the fast path.",
                  Allowed::whole(1, most_iterations));
    catalogue.add("Coarser meshes",
                  coarser_meshes,
                  "Meshes with half as many elements each, but two for each "
                  "tow that a fiber crosses, on which the fast path weaves "
                  "first, as long as a quarter of the elements is saved.",
                  Allowed::whole(0, 8));
    catalogue.leave_section();
  }



  void
  WeaveSettings::resolve(const Parameters &parameters)
  {
    if (parameters.is_preview())
      step = std::max(step, preview_step);
  }



  StageType
  Weave::type()
  {
    StageType type{"weave",
                   "moves the tows apart",
                   StageType::Sample::fabric,
                   &make<Weave>,
                   &make_settings<WeaveSettings>};
    type.starts_fabric = true;
    return type;
  }



  Weave::Weave(const Scene &scene)
    : Stage(scene)
    , settings(scene.parameters.stage_settings.get<WeaveSettings>())
    , full_overlap(0)
    , radius(scene.mesh.smallest_radius())
  {
    double thickness[2] = {0, 0};
    for (const Tow &tow : scene.fibers.tows)
      {
        double &largest = thickness[tow.family == Tow::Family::warp ? 0 : 1];
        largest         = std::max(largest, tow.half_thickness);
      }
    full_overlap = thickness[0] + thickness[1];
  }



  Supports
  Weave::supports(const DofVector &) const
  {
    return TowEnds::supports(scene, 3);
  }



  void
  Weave::begin(State &state) const
  {
    TowEnds::place(scene, MatrixBorders::Grip::none, state);
  }



  std::vector<BodyTarget>
  Weave::targets(const std::vector<Placement> &start, const double) const
  {
    std::vector<BodyTarget> targets(start.size());
    for (unsigned int b = 0; b < start.size(); ++b)
      targets[b].placement = start[b];
    return targets;
  }



  ContactRule
  Weave::rule(const double load) const
  {
    ContactRule rule;
    rule.from_above      = true;
    rule.allowed_overlap = (1 - load) * full_overlap;
    rule.friction        = scene.parameters.contact.friction_coefficient > 0;
    return rule;
  }



  double
  Weave::first_step(const State &) const
  {
    return std::min(1., settings.step * radius / full_overlap);
  }



  double
  Weave::least_force_scale(const double load) const
  {
    if (load >= 1)
      return 0;
    const ContactParameters &contact = scene.parameters.contact;
    return contact.initial_stiffness * contact.largest_penetration *
           scene.mesh.smallest_stiffness() * radius;
  }



  bool
  Weave::has_fast_path() const
  {
    return scene.parameters.is_preview() ||
           (settings.path != WeavingPath::nested &&
            scene.parameters.solver.loops != Loops::nested);
  }



  bool
  Weave::starts_coarsely() const
  {
    return has_fast_path() && !scene.parameters.is_preview() &&
           settings.coarser_meshes > 0;
  }



  bool
  Weave::take_fast_path(State       &state,
                        const State &before,
                        Equilibrium &equilibrium) const
  {
    if (!has_fast_path())
      return false;
    state = before;
    return weave_in_one_increment(state, before, equilibrium);
  }



  bool
  Weave::weave_in_one_increment(State       &state,
                                const State &before,
                                Equilibrium &equilibrium) const
  {
    Equilibrium::Problem problem{before, targets(state.placements, 1), {}};
    problem.rule.from_above = true;
    const double step       = settings.step * radius;
    const double damping    = scene.parameters.solver.damping;
    for (double overlap = full_overlap; overlap > 0;)
      {
        overlap                      = std::max(0., overlap - step);
        problem.rule.allowed_overlap = overlap;
        equilibrium.iterate(state,
                            problem,
                            settings.fast_iterations_per_step,
                            damping);
      }

    problem.rule = ContactRule();
    equilibrium.iterate(state,
                        problem,
                        settings.fast_iterations_per_step,
                        damping);
    return scene.parameters.is_preview() || settle(state, before, equilibrium);
  }



  bool
  Weave::settle(State       &state,
                const State &before,
                Equilibrium &equilibrium) const
  {
    // Friction starts where the fibers are now: nothing is locked in.
    Equilibrium::Problem problem{before, targets(before.placements, 1), {}};
    problem.is_first    = true;
    problem.near_enough = settings.near_enough;
    if (!equilibrium.solve_from(state, problem))
      return false;
    if (problem.near_enough > 0)
      return true;
    const State          reference = state;
    Equilibrium::Problem end{reference, problem.targets, {}};
    end.rule.friction = scene.parameters.contact.friction_coefficient > 0;
    return equilibrium.solve_by_newton(state, end);
  }



  CurveRow
  Weave::curve(const State &state, const std::vector<BodyVector> &) const
  {
    return {
      {{"allowed_overlap", Quantity::length}, (1 - state.load) * full_overlap}};
  }
} // namespace fiberloom
