// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_coupling_rigid_body_h
#define fiberloom_coupling_rigid_body_h

#include <fiberloom/base/vector_types.h>

#include <Eigen/Geometry>

#include <array>
#include <bitset>
#include <string>
#include <vector>

namespace fiberloom
{
  /** A force and a moment, or a displacement and a rotation vector. */
  using BodyVector = Eigen::Matrix<double, 6, 1>;

  /** Where a rigid body is: part of the state. */
  struct Placement
  {
    Vector3 position = Vector3::Zero(); // of its reference point [mm]
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
    Vector3 turn = Vector3::Zero(); // rotation vectors, summed up on the way
                                    // so that turns are counted [rad]

    template <class Archive>
    void
    serialize(Archive &ar, const unsigned int)
    {
      for (unsigned int i = 0; i < 3; ++i)
        ar &position[i];
      for (unsigned int i = 0; i < 4; ++i)
        ar &rotation.coeffs()[i];
      for (unsigned int i = 0; i < 3; ++i)
        ar &turn[i];
    }
  };

  /**
   * The vector of the rotation from @p before to @p after that counts as many
   * whole turns as @p guess , which may have come about in many small steps.
   */
  Vector3
  rotation_vector(const Eigen::Quaterniond &before,
                  const Eigen::Quaterniond &after,
                  const Vector3            &guess);

  /**
   * A node held by a rigid body. The node's nine dofs, x0 - position as
   * components along the columns of @p center_frame , r g1 and r g2 along those
   * of @p frame , both carried by the body, are fixed where @p held is set and
   * unknowns of the node elsewhere. So a clamped end holds the directions of
   * the section vectors but not their lengths, and a centre can be held while
   * its section is free.
   *
   * If @p radial is set, the fiber's axis may not tilt towards it although the
   * section can spin: in place of r g1 and r g2 stand the same vectors turned
   * in the section until the first of them lies along @p radial , their
   * components being along it, across it in the section, and along the axis.
   */
  struct Attachment
  {
    unsigned int   node;
    unsigned int   body;
    std::bitset<9> held;
    Matrix3        frame        = Matrix3::Identity(); // in the body's axes
    Matrix3        center_frame = Matrix3::Identity(); // the same
    Vector3        radial       = Vector3::Zero();     // the same, or 0: none
  };

  /**
   * Six degrees of freedom, three translations of the reference point and
   * three rotations about it, each prescribed or free; free ones may be
   * loaded by dead forces.
   */
  struct RigidBody
  {
    std::string    name;
    std::bitset<6> prescribed = std::bitset<6>().set();
  };

  /** What the bodies are to do over an increment. */
  struct BodyTarget
  {
    Placement  placement;                 // for prescribed dofs
    BodyVector load = BodyVector::Zero(); // [N], [N mm]
  };

  /** What an increment leads to. */
  struct Targets
  {
    std::vector<BodyTarget> bodies;
    std::vector<Vector3>    node_forces; // dead, on x0 [N]; empty: none

    Targets(std::vector<BodyTarget> bodies      = {},
            std::vector<Vector3>    node_forces = {})
      : bodies(std::move(bodies))
      , node_forces(std::move(node_forces))
    {}
  };

  /** The rigid bodies of a stage and the nodes they hold, at most one body a
   * node. */
  struct Supports
  {
    std::vector<RigidBody>  bodies;
    std::vector<Attachment> attachments;
  };
} // namespace fiberloom

#endif
