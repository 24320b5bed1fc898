// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_contact_contact_element_h
#define fiberloom_contact_contact_element_h

#include <fiberloom/base/vector_types.h>

#include <fiberloom/beams/fiber_mesh.h>

#include <array>

namespace fiberloom
{
  /**
   * A pair of material particles on the surfaces of two fibers that are
   * predicted to touch, section 3.3 of the paper, with the law that acts
   * between them. Generated anew at each detection; what must outlive that is
   * in ContactState. Equation [4] of the paper.
   */
  struct ContactElement
  {
    // who
    unsigned int                zone; // index into ContactState::zones
    unsigned int                part; // index into the zone's stiffness
    std::array<unsigned int, 2> fibers;
    std::array<ElementPoint, 2> points;
    std::array<unsigned int, 2> first_nodes;
    std::array<std::array<double, 3>, 2>
                          weights; // shape functions at the points
    std::array<double, 2> radii;   // [mm]

    /**
     * How the two points follow the fibers: not at all, or so that they stay
     * on the plane across the intermediate geometry through a material point
     * of the first fiber, or where the fibers are closest.
     */
    enum class Points
    {
      fixed,
      on_plane,
      closest
    };
    Points following   = Points::fixed;
    int    orientation = 1;                // closest: side of the zone,
                                           // on plane: sign of t1 . t2
    std::array<double, 2> u    = {{0, 0}}; // of the points that follow
    bool                  lost = false;    // their points are beyond finding
    // By a step's model, linear from where the contact is [N/mm].
    double stiffness_added = 0;

    // normal contact
    Vector3 normal;    // unit, from the second fiber to the first
    double  offset;    // added to the gap: overlap that is still allowed [mm]
    double  stiffness; // line penalty, force over length and gap [N/mm^2]
    double  length;    // of contact that the station stands for [mm]
    double  spread;    // of a crossing instead of a length, else 0 [mm^(1/2)]
    double  regularization; // penetration up to which the law is quadratic [mm]
    std::array<double, 2> skewness; // of the cut sections over the round ones

    // friction; a limit of 0 means none
    double  friction_limit;          // mu f* [N]
    double  normal_force_before = 0; // f* [N]
    Vector3 friction_normal;         // unit, across the plane of friction
    double  elastic_slip;            // [mm]
    Vector3 slip_before; // reversible slip at the start of the increment [mm]
    Vector3 separation_before; // of the two particles then [mm]
    std::array<std::array<double, 2>, 2>
      particles; // (z1, z2)/r of each particle, on the unit circle

    enum class Status
    {
      open,
      stick,
      slip
    };

    // what the last evaluation found
    double  gap            = 0;               // [mm]
    double  normal_force   = 0;               // [N], >= 0
    Vector3 friction_force = Vector3::Zero(); // on the first fiber [N]
    Vector3 slip           = Vector3::Zero(); // reversible slip [mm]
    Status  status         = Status::open;
  };
} // namespace fiberloom

#endif
