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
  /** Where a rigid body is: part of the state. */
  struct Placement
  {
    Vector3 position = Vector3::Zero(); // of its reference point [mm]
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();

    template <class Archive>
    void
    serialize(Archive &ar, const unsigned int)
    {
      for (unsigned int i = 0; i < 3; ++i)
        ar &position[i];
      for (unsigned int i = 0; i < 4; ++i)
        ar &rotation.coeffs()[i];
    }
  };

  /**
   * A node held by a rigid body. The node's nine dofs (x0 - position, r g1,
   * r g2), as components along the columns of @p frame carried by the body,
   * are fixed where @p held is set and unknowns of the node elsewhere. So a
   * clamped end holds the directions of the section vectors but not their
   * lengths, and a centre can be held while its section is free.
   */
  struct Attachment
  {
    unsigned int   node;
    unsigned int   body;
    std::bitset<9> held;
    Matrix3        frame = Matrix3::Identity(); // in the body's axes
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
    Placement                   placement; // for prescribed dofs
    Eigen::Matrix<double, 6, 1> load =
      Eigen::Matrix<double, 6, 1>::Zero(); // [N], [N mm]
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
