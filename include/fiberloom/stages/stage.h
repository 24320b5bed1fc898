// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_stages_stage_h
#define fiberloom_stages_stage_h

#include <fiberloom/base/stage_type.h>
#include <fiberloom/base/statistics.h>

#include <fiberloom/contact/contact_element.h>

#include <fiberloom/coupling/rigid_body.h>

#include <fiberloom/model/state.h>

#include <fiberloom/solvers/equilibrium.h>

#include <fiberloom/stages/column.h>
#include <fiberloom/stages/way.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace fiberloom
{
  /** What a stage shows to output after each accepted increment, on every rank;
   * a test also where it begins, as increment 0. */
  struct IncrementReport
  {
    const std::string                 &stage;
    const State                       &state;
    const std::vector<ContactElement> &contacts;
    const Supports                    &supports;
    const std::vector<BodyVector>     &reactions; // per body [N], [N mm]
    CurveRow                           curve;
    const StageStatistics             &statistics; // of the stage so far
    bool                               last;       // of the stage
    const Composite *composite = nullptr;          // null without matrix
  };

  /** What every stage is made from. */
  struct Scene
  {
    const Parameters &parameters;
    const FiberSet   &fibers;
    const FiberMesh  &mesh;
    const Composite  *composite = nullptr; // null without matrix
  };

  /**
   * One stage of a scene: which bodies hold what, where they go, and how
   * contact is generated, all as functions of a load that runs from 0 to 1.
   * Stages share one state. To add a stage, derive from this, give it a type()
   * and name that in stage_types.cc.
   */
  class Stage
  {
  public:
    explicit Stage(const Scene &scene)
      : scene(scene)
    {}

    virtual ~Stage() = default;

    /** Bodies and the nodes they hold; @p start is the placement of the fibers
     * where the stage begins. */
    virtual Supports
    supports(const DofVector &start) const = 0;

    /**
     * Prepares @p state at the start of the stage: placements of the bodies
     * where they have none.
     */
    virtual void
    begin(State &state) const = 0;

    /** Takes bodies that begin() has let press on the sample, so that they are
     * held by it, to where they do not: for the row at zero load. */
    virtual void
    unload(State & /*state*/) const
    {}

    /**
     * A past from which an even deformation of the whole sample would lead
     * @p state on over the next @p load_step : a first guess. Empty where the
     * stage knows of none.
     */
    virtual Past
    guess(const State & /*state*/, const double /*load_step*/) const
    {
      return {};
    }

    /**
     * Placement and load of each body at @p load ; @p start are the placements
     * where the stage began.
     */
    virtual std::vector<BodyTarget>
    targets(const std::vector<Placement> &start, const double load) const = 0;

    /**
     * Dead forces on x0 of the fiber nodes at @p load , one for each [N]; none
     * if empty.
     */
    virtual std::vector<Vector3>
    node_forces(const double /*load*/) const
    {
      return {};
    }

    /** Contacts found by distance, with the scene's friction, unless it weaves.
     */
    virtual ContactRule
    rule(const double load) const;

    /** Length of the first increment, as a part of the load. */
    virtual double
    first_step(const State &state) const = 0;

    /** Largest length of an increment, as a part of the load. */
    virtual double
    largest_step() const
    {
      return 1;
    }

    /** Where an increment of length @p step ends that begins at @p load : a
     * rest that would be tiny is taken along. */
    double
    end_of_increment(const double load, const double step) const;

    /** Increments from @p load to the end, the first one of length @p step ,
     * if none fails; @p state is where the stage begins or is. */
    unsigned int
    n_increments(const State &state,
                 const double load,
                 const double step) const;

    /** The next load beyond @p load at which an increment has to end. */
    virtual double
    next_stop(const double load) const
    {
      return way() ? way()->next_turn(load) : 1;
    }

    /** The way of a test that may turn back, null where there is none. Each leg
     * of it starts with the first step, and work is counted. */
    virtual const Way *
    way() const
    {
      return nullptr;
    }

    /** Forces below this need not be resolved on the way [N]. */
    virtual double
    least_force_scale(const double /*load*/) const
    {
      return 0;
    }

    /**
     * A cheaper way to the end of the stage than by increments, tried once at
     * its start. False, with @p state spoilt, where there is none or it fails.
     */
    virtual bool
    take_fast_path(State &, const State & /*before*/, Equilibrium &) const
    {
      return false;
    }

    /** Whether a coarser mesh may go before, from where the fibers are made. */
    virtual bool
    starts_coarsely() const
    {
      return false;
    }

    /**
     * Goes on from where the fast path led on a coarser mesh to the end of the
     * stage. False, with @p state spoilt, where there is none or it fails.
     */
    virtual bool
    settle(State &, const State & /*before*/, Equilibrium &) const
    {
      return false;
    }

    /** Whether the curve tells how the sample answers a load. */
    virtual bool
    is_test() const
    {
      return true;
    }

    /**
     * The stage's columns of the loading curve at @p state , where bodies exert
     * @p reactions on the sample [N], [N mm].
     */
    virtual CurveRow
    curve(const State                   &state,
          const std::vector<BodyVector> &reactions) const = 0;

    /** Whether the curve also gets the force with which neighboring tows of a
     * family press on each other. */
    virtual bool
    shows_neighbors() const
    {
      return false;
    }

    /** Whether the curve also gets contact forces, energies and pivots. */
    virtual bool
    shows_balance() const
    {
      return false;
    }

    /** Whether the stage ends with the stiffness of the cell. */
    virtual bool
    finds_stiffness() const
    {
      return false;
    }

    /** What the user should know about how the input was understood. */
    virtual std::vector<std::string>
    notes() const
    {
      return {};
    }

  protected:
    const Scene scene;
  };

  /** The stage of the type @p name . Throws InputError where there is none. */
  std::unique_ptr<Stage>
  create_stage(const std::string &name, const Scene &scene);

  /** Creates a stage of this type, for StageType::create. */
  template <class Type>
  std::unique_ptr<Stage>
  make(const Scene &scene)
  {
    return std::make_unique<Type>(scene);
  }

  using IncrementObserver = std::function<void(const IncrementReport &)>;
} // namespace fiberloom

#endif
