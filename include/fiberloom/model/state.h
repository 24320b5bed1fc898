// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_model_state_h
#define fiberloom_model_state_h

#include <fiberloom/base/vector_types.h>

#include <fiberloom/beams/fiber_history.h>

#include <fiberloom/contact/contact_state.h>

#include <fiberloom/coupling/rigid_body.h>

#include <fiberloom/model/composite.h>

#include <boost/serialization/vector.hpp>

#include <string>
#include <vector>

namespace fiberloom
{
  /**
   * Where everything was at an earlier load: dofs as in State::q [mm],
   * placements of the bodies, and that load. It knows of nothing where q is
   * empty.
   */
  struct Past
  {
    DofVector              q;
    std::vector<Placement> placements;
    double                 load = 0;
  };



  /**
   * Where a stage that starts on coarser meshes goes on from, carried over from
   * them to this mesh. It knows of nothing where q is empty.
   */
  struct CoarseRest
  {
    DofVector              q;
    std::vector<Placement> placements;
    ContactState           contact;
  };



  /**
   * Everything that changes over an increment. A copy of it is a commit, the
   * assignment of that copy a rollback; two runs with equal states go on
   * equally. The same on every rank.
   */
  struct State
  {
    // Fiber dofs, see FiberMesh, then positions of the matrix's nodes.
    DofVector                q;
    MatrixState              matrix;
    std::vector<Placement>   placements; // of the rigid bodies of the stage
    std::vector<Placement>   stage_start_placements;
    DofVector                stage_start_q;
    std::vector<ContactZone> stage_start_zones;
    ContactState             contact;
    FiberHistory             fibers;

    Past       previous; // one increment ago, to extrapolate from
    CoarseRest coarse;   // of a stage without an increment

    unsigned int stage     = 0; // index into the stages of the scene
    unsigned int increment = 0; // accepted in the stage
    double       load      = 0; // of the stage, from 0 to 1
    double step = 0; // of the load, to be tried next; 0: the stage's first step
    double dissipation = 0; // by friction, so far [N mm]

    // Of a stage with a way: what the bodies exert on the fibers [N], [N mm],
    // and the work that they have done in the stage [N mm].
    std::vector<BodyVector> reactions;
    double                  work = 0;

    std::vector<std::string> stages_done;
    std::vector<std::string> scene_stages; // of the run that wrote it

    /**
     * Enters stage number @p number of the scene: counts increments and load
     * from 0, lets the stage choose its first step, and forgets the reactions,
     * the work and the past of the stage before. Placement, contacts and what
     * materials remember stay.
     */
    void
    begin_stage(const unsigned int number)
    {
      stage     = number;
      increment = 0;
      load      = 0;
      step      = 0;
      work      = 0;
      reactions.clear();
      previous.q.resize(0);
      coarse = {};
    }

    /** Name of the stage that the state is in; empty after the last one. */
    std::string
    stage_name() const
    {
      return stage < scene_stages.size() ? scene_stages[stage] : "";
    }

    template <class Archive>
    void
    serialize(Archive &ar, const unsigned int)
    {
      for (DofVector *dofs : {&q, &stage_start_q, &previous.q, &coarse.q})
        {
          auto n = dofs->size();
          ar  &n;
          dofs->resize(n);
          for (auto &value : *dofs)
            ar &value;
        }
      ar                                                        &matrix;
      ar &placements &stage_start_placements &stage_start_zones &contact;
      ar &previous.placements &previous.load &coarse.placements &coarse.contact;
      ar &stage &increment &load &step                          &dissipation;
      ar &stages_done &scene_stages                             &fibers;
      Eigen::Index n = reactions.size();
      ar          &n;
      reactions.resize(n);
      for (BodyVector &reaction : reactions)
        for (double &value : reaction)
          ar &value;
      ar &work;
    }
  };
} // namespace fiberloom

#endif
