// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_coupling_rigid_body_h
#define fiberloom_coupling_rigid_body_h

#include <fiberloom/base/vector_types.h>

#include <Eigen/Geometry>

#include <array>
#include <bitset>
#include <cmath>
#include <optional>
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
   *
   * If @p carried is set, the body is that of a PeriodicCell, and what it does
   * to the node is to move its centre by this matrix times the elongations.
   * Section 3.1 of the theory.
   */
  struct Attachment
  {
    unsigned int   node;
    unsigned int   body;
    std::bitset<9> held;
    Matrix3        frame        = Matrix3::Identity(); // in the body's axes
    Matrix3        center_frame = Matrix3::Identity(); // the same
    Vector3        radial       = Vector3::Zero();     // the same, or 0: none

    std::optional<Matrix3> carried = {};
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

  /**
   * The mean deformation of a periodic cell. One of the bodies stands for it:
   * its position are the elongations (a, b, c) [mm] of the periods P_x, P_y,
   *   F P_x = (P_x + a, c P_x / 2 L, 0),  F P_y = (c P_y / 2 L, P_y + b, 0)
   * with L^2 = P_x P_y, so that c / L is the shear strain and F symmetric: the
   * cell does not turn. Forces on it are mean stresses times a width of the
   * cell; it does not rotate. Section 3.2 of the theory.
   */
  struct PeriodicCell
  {
    unsigned int          body;
    std::array<double, 2> size; // stress-free periods [mm]

    /**
     * Sum of @p x periods along x and @p y along y where they are stress-free
     * [mm].
     */
    Vector3
    shift(const double x, const double y) const
    {
      return {x * size[0], y * size[1], 0};
    }

    /**
     * The matrix by which the elongations (a, b, c) are multiplied to get what
     * they add to shift( @p x , @p y ).
     */
    Matrix3
    slope(const double x, const double y) const
    {
      const double ratio = .5 * std::sqrt(size[0] / size[1]);
      Matrix3      slope;
      slope << x, 0, .25 * y / ratio, 0, y, x * ratio, 0, 0, 0;
      return slope;
    }
  };

  /**
   * Two rigid horizontal plates that fibers touch. One of the bodies stands for
   * them, (distance, 0, height of the middle) [mm] being its position; the
   * force on the distance is less the mean of what presses on both. Section 3.3
   * of the theory.
   */
  struct Plates
  {
    unsigned int body;
    double       stiffness;      // per length of fiber, over its modulus
    double       regularization; // of the penalty, over the fiber's radius
    double       spring;         // of the middle, for want of contact, over E r
    unsigned int stations_per_element;
    double       friction_coefficient = 0;
    double       elastic_slip         = 0; // over the fiber's radius
  };

  /** The rigid bodies of a stage and the nodes they hold, at most one body a
   * node. */
  struct Supports
  {
    std::vector<RigidBody>      bodies;
    std::vector<Attachment>     attachments;
    std::optional<PeriodicCell> cell   = {}; // where the fibers are one
    std::optional<Plates>       plates = {};
  };
} // namespace fiberloom

#endif
