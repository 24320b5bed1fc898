// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_tests_sample_model_h
#define fiberloom_tests_sample_model_h

#include <fiberloom/contact/contact_law.h>

#include <fiberloom/coupling/hold.h>

#include <fiberloom/model/system.h>

#include <Epetra_Vector.h>

#include <cstdlib>

#include "sample_fibers.h"

/**
 * Two crossing fibers in contact and a curved third one, held by two rigid
 * bodies in every way there is: the first free in all dofs and loaded, the
 * second prescribed in some. A force acts on a node held by the first one.
 */
struct SampleModel
{
  const fiberloom::FiberSet              fibers;
  const fiberloom::FiberMesh             mesh;
  fiberloom::Supports                    supports;
  fiberloom::State                       state;
  fiberloom::Targets                     targets;
  std::vector<fiberloom::ContactElement> contacts;

  explicit SampleModel(const unsigned int n_elements = 2)
    : fibers(make_fibers(n_elements))
    , mesh(fibers)
  {
    using namespace fiberloom;
    state.q = mesh.reference();
    supports.bodies.resize(2);
    supports.bodies[0].name = "free";
    supports.bodies[0].prescribed.reset();
    supports.bodies[1].name = "half";
    for (const unsigned int dof : {1, 3, 5})
      supports.bodies[1].prescribed.reset(dof);
    hold(0, false, 0, Hold::clamped);
    hold(0, true, 1, Hold::clamped);
    hold(1, false, 0, Hold::pinned);
    hold(1, true, 1, Hold::direction);
    hold(2, false, 0, Hold::axial);
    hold(2, true, 1, Hold::center);

    state.placements.resize(2);
    state.placements[0].position = Vector3(-7, 1, 2);
    state.placements[1].position = Vector3(6, -2, 1);
    targets.bodies.resize(2);
    targets.bodies[0].load << .01, -.02, .03, 0, 0, 0;
    for (unsigned int b = 0; b < 2; ++b)
      targets.bodies[b].placement = state.placements[b];
    targets.node_forces.assign(mesh.n_nodes(), Vector3::Zero());
    targets.node_forces[0] = Vector3(.02, .01, -.03);
    targets.node_forces[1] = Vector3(.01, .03, .02);
  }

  /** Moves all unknowns a little, the same on any number of ranks. */
  void
  disturb(const fiberloom::System &system)
  {
    std::srand(5);
    const auto n = system.layout().n_dofs();
    system.motion().advance(state, .001 * Eigen::VectorXd::Random(n), 1);
  }

  /** Pushes fibers 0 and 1, 1 and 2 together where they are. */
  void
  add_contacts(const double penetration, const double friction_limit)
  {
    using namespace fiberloom;
    for (const unsigned int first : {0, 1})
      {
        ContactElement contact;
        contact.fibers = {{first, first + 1}};
        contact.radii  = {{1, 1}};
        for (unsigned int s = 0; s < 2; ++s)
          {
            const double u         = .4 + .5 * s;
            contact.points[s]      = mesh.locate(contact.fibers[s], u);
            contact.first_nodes[s] = mesh.first_node(contact.points[s].element);
            contact.weights[s]     = shape_values(contact.points[s].xi);
          }
        const SectionPair x     = section_pair(contact, state.q);
        contact.normal          = (x.head<3>() - x.segment<3>(9)).normalized();
        contact.friction_normal = contact.normal;
        contact.offset          = 0;
        contact.stiffness       = .3;
        contact.length          = 1;
        contact.spread          = 0;
        contact.skewness        = {{1, 1}};
        contact.regularization  = .005;
        contact.friction_limit  = friction_limit;
        contact.elastic_slip    = .05;
        contact.slip_before     = .02 * contact.normal.unitOrthogonal();
        place_particles(contact, x);
        contact.separation_before = particle_separation(contact, x);
        contact.offset            = -penetration - contact_gap(contact, x);
        contacts.push_back(contact);
      }
  }

private:
  static fiberloom::FiberSet
  make_fibers(const unsigned int n_elements)
  {
    const auto arc = [](const double t) {
      return fiberloom::Vector3(8 * std::cos(t) - 6, 8 * std::sin(t), 4);
    };
    return loose_fibers(
      {straight_fiber({-6, 0, 0}, {6, 1, 0}, n_elements),
       straight_fiber({0, -6, 2}, {1, 6, 2}, n_elements),
       curved_fiber(arc, n_elements, fiberloom::Vector3::UnitZ())});
  }

  void
  hold(const unsigned int    fiber,
       const bool            end,
       const unsigned int    body,
       const fiberloom::Hold how)
  {
    const auto &line = mesh.lines()[fiber];
    supports.attachments.push_back(fiberloom::attach(
      state.q, line.first_node + (end ? line.n_nodes() - 1 : 0), body, how));
  }
};

/** The product of the system's matrix and @p x , whole on every rank. */
inline Eigen::VectorXd
multiply(fiberloom::System &system, const Eigen::VectorXd &x)
{
  const Epetra_Map map = system.matrix().OperatorDomainMap();
  Epetra_Vector    part(map), product(map);
  for (int i = 0; i < part.MyLength(); ++i)
    part[i] = x[map.GID(i)];
  system.matrix().Apply(part, product);
  return system.gather(
    std::vector<double>(product.Values(),
                        product.Values() + product.MyLength()));
}

#endif
