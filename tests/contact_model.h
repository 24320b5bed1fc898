// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_tests_contact_model_h
#define fiberloom_tests_contact_model_h

#include <fiberloom/base/parameters.h>

#include <fiberloom/contact/contact_generator.h>

#include <deal.II/base/mpi.h>

#include <vector>

#include "sample_fibers.h"

inline const fiberloom::ContactRule standard;

inline fiberloom::ContactParameters
contact_parameters(const double line_stiffness)
{
  fiberloom::ContactParameters parameters;
  parameters.line_stiffness       = line_stiffness;
  parameters.largest_penetration  = .02;
  parameters.stations_per_element = 2;
  return parameters;
}

/** Fibers with all that the generation of contacts refers to. */
struct ContactModel
{
  const fiberloom::FiberSet          fibers;
  const fiberloom::FiberMesh         mesh;
  const fiberloom::ContactParameters parameters;
  fiberloom::ContactGenerator        generator;
  fiberloom::DofVector               q;
  fiberloom::ContactState            state;

  explicit ContactModel(const std::vector<fiberloom::Fiber> &list,
                        const double                         line_stiffness = 0)
    : ContactModel(loose_fibers(list), line_stiffness)
  {}

  explicit ContactModel(const fiberloom::FiberSet &set,
                        const double               line_stiffness = 0)
    : fibers(set)
    , mesh(fibers)
    , parameters(contact_parameters(line_stiffness))
    , generator(fibers, mesh, parameters, MPI_COMM_WORLD)
    , q(mesh.reference())
  {}

  std::vector<fiberloom::ContactElement>
  generate(const fiberloom::ContactRule &rule = standard)
  {
    return generator.generate(q, q, rule, state);
  }

  void
  shift(const unsigned int fiber, const fiberloom::Vector3 &by)
  {
    const auto &line = mesh.lines()[fiber];
    for (unsigned int n = 0; n < line.n_nodes(); ++n)
      q.segment<3>(9 * (line.first_node + n)) += by;
  }

  double
  u(const fiberloom::ContactElement &contact, const unsigned int side) const
  {
    return mesh.parameter(contact.points[side]);
  }
};

inline fiberloom::Fiber
along_x(const double z = 0)
{
  return straight_fiber({-20, 0, z}, {20, 0, z}, 4);
}

#endif
