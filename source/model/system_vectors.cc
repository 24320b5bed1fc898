// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/model/system.h>

#include <deal.II/base/mpi.h>

#include <Epetra_Vector.h>

#include <algorithm>
#include <cmath>

namespace fiberloom
{
  RigidModes
  System::rigid_modes() const
  {
    // Near enough to a body's reference point, which is part of the state.
    const auto node_center = [this](const unsigned int node) {
      return node < mesh.n_nodes() ?
               Vector3(mesh.reference().segment<3>(9 * node)) :
               Vector3(composite->matrix().reference().segment<3>(
                 3 * (node - mesh.n_nodes())));
    };
    std::vector<Vector3>      centers(supports.bodies.size(), Vector3::Zero());
    std::vector<unsigned int> n_held(supports.bodies.size(), 0);
    for (const Attachment &attachment : supports.attachments)
      {
        centers[attachment.body] += node_center(attachment.node);
        ++n_held[attachment.body];
      }
    for (unsigned int b = 0; b < centers.size(); ++b)
      centers[b] /= std::max(1u, n_held[b]);

    std::array<std::vector<double>, 6> modes;
    for (unsigned int mode = 0; mode < 6; ++mode)
      {
        Vector3 shift = Vector3::Zero(), turn = Vector3::Zero();
        (mode < 3 ? shift : turn)[mode % 3] = 1;
        for (const unsigned int block : numbering.owned_blocks())
          {
            Eigen::VectorXd change(numbering.size(block));
            if (block >= numbering.n_nodes())
              change << shift +
                          turn.cross(centers[block - numbering.n_nodes()]),
                turn;
            else if (movement.attachment(block) >= 0)
              change.setZero(); // goes with its body
            else if (block >= mesh.n_nodes())
              change = shift + turn.cross(node_center(block));
            else
              for (unsigned int v = 0; v < 3; ++v)
                change.segment<3>(3 * v) =
                  (v == 0 ? shift : Vector3::Zero().eval()) +
                  turn.cross(mesh.reference().segment<3>(9 * block + 3 * v));
            for (unsigned int k = 0; k < change.size(); ++k)
              modes[mode].push_back(
                movement.is_fixed(numbering.first_dof(block) + k) ? 0 :
                                                                    change[k]);
          }
      }
    return modes;
  }



  std::vector<double>
  System::free_residual() const
  {
    std::vector<double> free = sum.residual();
    for (unsigned int row = 0; row < numbering.owned_blocks().size(); ++row)
      {
        const unsigned int block = numbering.owned_blocks()[row];
        for (unsigned int i = 0; i < numbering.size(block); ++i)
          if (movement.is_fixed(numbering.first_dof(block) + i))
            free[numbering.local_first_dof(row) + i] = 0;
      }
    return free;
  }



  std::vector<double>
  System::unbalanced_forces() const
  {
    const std::vector<double> free = free_residual();
    std::vector<double>       forces;
    for (unsigned int row = 0; row < numbering.owned_blocks().size(); ++row)
      {
        const unsigned int block = numbering.owned_blocks()[row];
        double             force = 0;
        for (unsigned int i = 0; i < numbering.size(block); ++i)
          {
            const bool   moment = block >= numbering.n_nodes() && i >= 3;
            const double value =
              std::abs(free[numbering.local_first_dof(row) + i]);
            force =
              std::max(force, moment ? value / mesh.smallest_radius() : value);
          }
        forces.push_back(force);
      }
    return forces;
  }



  double
  System::residual_norm() const
  {
    double norm = 0;
    for (const double force : unbalanced_forces())
      norm = std::max(norm, force);
    return dealii::Utilities::MPI::max(norm, numbering.communicator());
  }



  unsigned int
  System::most_unbalanced() const
  {
    const double              norm   = residual_norm();
    const std::vector<double> forces = unbalanced_forces();
    unsigned int              first  = numbering.n_blocks();
    for (unsigned int row = 0; row < forces.size(); ++row)
      if (forces[row] == norm)
        first = std::min(first, numbering.owned_blocks()[row]);
    return dealii::Utilities::MPI::min(first, numbering.communicator());
  }



  double
  System::force_scale() const
  {
    return sum.largest_force();
  }



  Eigen::VectorXd
  System::gather(const std::vector<double> &owned_solution) const
  {
    const Epetra_Vector owned(Copy,
                              *owned_map,
                              const_cast<double *>(owned_solution.data()));
    Epetra_Vector       all(*everything);
    const int           error = all.Import(owned, *importer, Insert);
    AssertThrow(error == 0, dealii::ExcMessage("import of the increment"));
    return Eigen::Map<const Eigen::VectorXd>(all.Values(), all.MyLength());
  }
} // namespace fiberloom
