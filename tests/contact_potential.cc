// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// Normal contact with points that follow the fibers: gradient and Hessian by
// differences, for both kinds of points, on and between element borders.

#include <fiberloom/contact/contact_potential.h>

#include <fstream>

#include "checks.h"
#include "sample_fibers.h"

using namespace fiberloom;

namespace
{
  struct Pair
  {
    FiberSet  fibers;
    FiberMesh mesh;
    DofVector q;

    explicit Pair(const Vector3 &direction)
      : fibers(two(direction))
      , mesh(fibers)
      , q(mesh.reference())
    {
      std::srand(3);
      q += .1 * DofVector::Random(q.size());
    }

    static FiberSet
    two(const Vector3 &direction)
    {
      FiberSet set;
      for (unsigned int f = 0; f < 2; ++f)
        {
          const Vector3 middle = f * Vector3(1, 2, 1.9);
          const Vector3 along  = 10 * (f == 0 ? Vector3::UnitX() : direction);
          set.fibers.push_back(
            straight_fiber(middle - along, middle + along, 4));
        }
      return set;
    }
  };

  ContactElement
  contact_between(const Pair &pair, const ContactElement::Points following)
  {
    ContactElement contact;
    contact.fibers    = {{0, 1}};
    contact.following = following;
    contact.u         = {{1.8, 2.1}};
    contact.radii     = {{1, 1}};
    const Section a   = pair.mesh.section(pair.q, pair.mesh.locate(0, 2)),
                  b   = pair.mesh.section(pair.q, pair.mesh.locate(1, 2));
    contact.orientation =
      following == ContactElement::Points::closest ?
        ((a.center - b.center).dot(a.tangent().cross(b.tangent())) > 0 ? 1 :
                                                                         -1) :
        (a.tangent().dot(b.tangent()) > 0 ? 1 : -1);
    contact.offset         = -1.5;
    contact.stiffness      = 3;
    contact.length         = 4;
    contact.regularization = .1;
    return contact;
  }

  DofVector
  gradient(ContactElement contact, const Pair &pair, const DofVector &q)
  {
    ContactPotential potential;
    DofVector        g = DofVector::Zero(q.size());
    if (evaluate_normal(contact, pair.mesh, q, potential, Curvature::none))
      for (unsigned int a = 0; a < potential.n; ++a)
        g.segment<9>(9 * potential.nodes[a]) +=
          potential.value[a] *
          potential.residual.segment<9>(9 * potential.fiber[a]);
    return g;
  }

  void
  check(const Pair &pair, const ContactElement &contact, Checks &checks)
  {
    const DofVector direction = DofVector::Random(pair.q.size());
    const double    step      = 1e-6;
    ContactElement  copy      = contact;
    const double    after =
      normal_energy(copy = contact, pair.mesh, pair.q + step * direction);
    const double before =
      normal_energy(copy = contact, pair.mesh, pair.q - step * direction);
    const DofVector  g = gradient(contact, pair, pair.q);
    ContactPotential potential;
    evaluate_normal(
      copy = contact, pair.mesh, pair.q, potential, Curvature::exact);
    const double scale = copy.normal_force;
    checks.above("force", scale, 1e-3);
    checks.below("gradient",
                 (g.dot(direction) - (after - before) / (2 * step)) / scale,
                 1e-7);

    const DofVector difference =
      (gradient(contact, pair, pair.q + step * direction) -
       gradient(contact, pair, pair.q - step * direction)) /
      (2 * step);
    DofVector product = DofVector::Zero(pair.q.size());
    double    force   = 0;
    for (unsigned int a = 0; a < potential.n; ++a)
      {
        const unsigned int s = potential.fiber[a];
        force +=
          potential.value[a] * potential.force_slope.segment<9>(9 * s).dot(
                                 direction.segment<9>(9 * potential.nodes[a]));
        for (unsigned int b = 0; b < potential.n; ++b)
          product.segment<9>(9 * potential.nodes[a]) +=
            potential.block(a, b) *
            direction.segment<9>(9 * potential.nodes[b]);
      }
    checks.below("Hessian",
                 (product - difference).norm() / difference.norm(),
                 1e-7);

    ContactElement there = contact, here = contact;
    normal_energy(there, pair.mesh, pair.q + step * direction);
    normal_energy(here, pair.mesh, pair.q - step * direction);
    checks.below("slope of the force",
                 force /
                     ((there.normal_force - here.normal_force) / (2 * step)) -
                   1,
                 1e-6);
    Vector3 sum = Vector3::Zero();
    for (unsigned int n = 0; n < pair.mesh.n_nodes(); ++n)
      sum += g.segment<3>(9 * n);
    checks.below("sum of forces", sum.norm() / scale, 1e-12);
    Vector3 moment = Vector3::Zero();
    for (unsigned int n = 0; n < 3 * pair.mesh.n_nodes(); ++n)
      moment += pair.q.segment<3>(3 * n).cross(Vector3(g.segment<3>(3 * n)));
    checks.below("sum of moments", moment.norm() / scale, 1e-12);
  }
} // namespace



int
main()
{
  std::ofstream output("output");
  Checks        checks(output);
  for (const Vector3 &direction :
       {Vector3(1, .05, .02), Vector3(-1, .1, 0), Vector3(.9, .4, .05)})
    {
      const Pair     pair(direction);
      ContactElement contact =
        contact_between(pair, ContactElement::Points::on_plane);
      for (const double u : {1.6, 2.1})
        {
          contact.u[0] = u;
          check(pair, contact, checks);
        }
    }
  for (const Vector3 &direction :
       {Vector3(.1, 1, .02), Vector3(.5, .8, 0), Vector3(-.2, -1, .1)})
    {
      const Pair pair(direction);
      check(pair,
            contact_between(pair, ContactElement::Points::closest),
            checks);
    }
}
