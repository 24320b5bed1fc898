// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/model/composite_terms.h>
#include <fiberloom/model/element_groups.h>
#include <fiberloom/model/fiber_term.h>
#include <fiberloom/model/system.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>

#include <Epetra_LocalMap.h>
#include <Epetra_Vector.h>

#include <algorithm>

namespace fiberloom
{
  namespace
  {
    /** Stiffness of the matrix's cells over that of the fibers, at most 1. */
    double
    matrix_weight(const Composite *composite, const FiberMesh &mesh)
    {
      if (composite == nullptr)
        return 1;
      const MatrixMesh &matrix = composite->matrix();
      return std::min(1.,
                      matrix.law().stiffness(Matrix3::Identity())(0, 0) *
                        matrix.cell_size() / mesh.smallest_stiffness());
    }

    double
    rotation_lever(const FiberMesh &mesh)
    {
      // Turns a body's unbalanced moment into a force for the norm.
      return mesh.smallest_radius();
    }
  } // namespace



  System::System(const FiberMesh &mesh,
                 const Supports  &supports,
                 MPI_Comm         comm,
                 const Composite *composite)
    : mesh(mesh)
    , supports(supports)
    , composite(composite)
    , originals(composite == nullptr ? mesh.originals() :
                                       composite->originals())
    , numbering(mesh,
                composite == nullptr ? Eigen::VectorXd() :
                                       composite->matrix().reference(),
                supports.bodies.size(),
                comm)
    , movement(mesh, supports, numbering, originals)
    , system_matrix(numbering,
                    rotation_lever(mesh),
                    matrix_weight(composite, mesh))
    , restricted_matrix(numbering,
                        rotation_lever(mesh),
                        matrix_weight(composite, mesh))
    , sum(movement, supports, numbering, system_matrix)
    , contact_term(mesh, numbering)
    , stiffness(mesh.smallest_stiffness())
    , rhs(numbering.n_owned_dofs())
    , body_reactions(supports.bodies.size(), BodyVector::Zero())
    , pending(numbering.n_dofs(), 0.)
  {
    terms.push_back(std::make_unique<FiberTerm>(mesh, originals, numbering));
    if (composite != nullptr)
      {
        terms.push_back(std::make_unique<CellTerm>(*composite, numbering));
        terms.push_back(std::make_unique<JunctionTerm>(*composite, numbering));
      }
    auto plates = std::make_unique<PlateTerm>(mesh, supports, numbering);
    plate_term  = plates.get();
    terms.push_back(std::move(plates));
    for (const auto &term : terms)
      rounding = std::max(rounding, term->rounding());

    owned_map = std::make_unique<Epetra_Map>(
      numbering.owned_dofs().make_trilinos_map(comm, false));
    everything =
      std::make_unique<Epetra_LocalMap>(static_cast<int>(numbering.n_dofs()),
                                        0,
                                        owned_map->Comm());
    importer = std::make_unique<Epetra_Import>(*everything, *owned_map);
  }



  namespace
  {
    /** The blocks a group of nodes couples: the nodes, or what they are images
     * of, and the bodies that hold them. */
    void
    append_bodies(const Motion                 &motion,
                  const Supports               &supports,
                  const BlockLayout            &layout,
                  const std::vector<NodeImage> &images,
                  std::vector<unsigned int>    &blocks)
    {
      const unsigned int n         = blocks.size();
      bool               with_cell = false;
      if (!images.empty())
        for (unsigned int &block : blocks)
          {
            if (block >= images.size())
              continue; // a body
            const NodeImage &image = images[block];
            with_cell = with_cell || image.periods != std::array<int, 2>();
            block     = image.node;
          }
      if (with_cell)
        blocks.push_back(layout.body_block(supports.cell->body));
      for (unsigned int a = 0; a < n; ++a)
        if (const int i = motion.attachment(blocks[a]); i >= 0)
          blocks.push_back(layout.body_block(supports.attachments[i].body));
    }

    void
    couple(const BlockLayout                      &layout,
           const std::vector<unsigned int>        &blocks,
           std::vector<std::vector<unsigned int>> &pattern)
    {
      for (const unsigned int row : blocks)
        if (const int local = layout.local_block(row); local >= 0)
          pattern[local].insert(pattern[local].end(),
                                blocks.begin(),
                                blocks.end());
    }

    void
    sort_unique(std::vector<std::vector<unsigned int>> &pattern)
    {
      for (auto &row : pattern)
        {
          std::sort(row.begin(), row.end());
          row.erase(std::unique(row.begin(), row.end()), row.end());
        }
    }
  } // namespace



  std::vector<std::vector<unsigned int>>
  System::fixed_couplings() const
  {
    std::vector<std::vector<unsigned int>> pattern(
      numbering.owned_blocks().size());
    for (const auto &term : terms)
      term->visit_couplings([&](std::vector<unsigned int> &blocks) {
        append_bodies(movement, supports, numbering, originals, blocks);
        if (std::any_of(blocks.begin(),
                        blocks.end(),
                        [this](const unsigned int block) {
                          return sum.takes(block);
                        }))
          couple(numbering, blocks, pattern);
      });
    // Also what no term touches has a diagonal.
    for (const unsigned int block : numbering.owned_blocks())
      couple(numbering, {block}, pattern);
    sort_unique(pattern);
    return pattern;
  }



  void
  System::restrict_to(const std::vector<char> &blocks)
  {
    sum.restrict_to(blocks, blocks.empty() ? system_matrix : restricted_matrix);
  }



  void
  System::reinit(const std::vector<ContactElement> &contacts)
  {
    if (!sum.is_restricted() && fixed_pattern.empty())
      fixed_pattern = fixed_couplings();

    auto pattern = sum.is_restricted() ? fixed_couplings() : fixed_pattern;
    contact_term.visit_couplings(contacts,
                                 sum,
                                 [&](std::vector<unsigned int> &blocks) {
                                   append_bodies(movement,
                                                 supports,
                                                 numbering,
                                                 contact_term.images(),
                                                 blocks);
                                   couple(numbering, blocks, pattern);
                                 });
    sort_unique(pattern);
    matrix().reinit(std::move(pattern));
  }



  void
  System::assemble_all(const State                 &state,
                       const Targets               &targets,
                       std::vector<ContactElement> &contacts,
                       const Curvature              curvature)
  {
    sum.begin(state, curvature);
    for (const auto &term : terms)
      term->add(state, sum);
    contact_term.add(state, contacts, sum);
    sum.reduce_largest_force();
    add_node_forces(targets);
    sum_reactions();
    add_body_loads(targets);
  }



  void
  System::sum_reactions()
  {
    for (unsigned int b = 0; b < body_reactions.size(); ++b)
      {
        body_reactions[b].setZero();
        if (const int local = numbering.local_block(numbering.body_block(b));
            local >= 0)
          body_reactions[b] = Eigen::Map<const BodyVector>(sum.forces(local));
      }
    if (!body_reactions.empty())
      MPI_Allreduce(MPI_IN_PLACE,
                    body_reactions.data(),
                    6 * body_reactions.size(),
                    MPI_DOUBLE,
                    MPI_SUM,
                    numbering.communicator());
  }



  void
  System::add_stiffness(const State                       &state,
                        const std::vector<ContactElement> &contacts)
  {
    std::vector<double> balance(rhs.size(), 0.);
    sum.swap_residual(balance);
    sum.go_on(state);
    contact_term.add_stiffness(state, contacts, sum);
    for (unsigned int i = 0; i < rhs.size(); ++i)
      rhs[i] -= sum.residual()[i];
    sum.swap_residual(balance);
    eliminate_fixed(pending);
  }



  void
  System::add_node_forces(const Targets &targets)
  {
    for (unsigned int n = 0; n < targets.node_forces.size(); ++n)
      {
        const NodeGroup group{{{n}}, targets.node_forces[n]};
        sum.note_force(group.outer_force.lpNorm<Eigen::Infinity>());
        if (sum.touches_owned(&n, 1, originals))
          sum.scatter(group, originals);
      }
  }



  void
  System::add_body_loads(const Targets &targets)
  {
    for (unsigned int b = 0; b < targets.bodies.size(); ++b)
      {
        const BodyVector &load = targets.bodies[b].load;
        sum.note_force(load.head<3>().lpNorm<Eigen::Infinity>());
        sum.note_force(load.tail<3>().lpNorm<Eigen::Infinity>() /
                       rotation_lever(mesh));
        const unsigned int block = numbering.body_block(b);
        const int          local = numbering.local_block(block);
        if (local < 0)
          continue;
        Eigen::Map<BodyVector>(sum.forces(local)) -= load;
        // A moment fixed in space has no potential: as rotation vectors start
        // anew at each placement, the slope of the residual is unsymmetric.
        if (sum.with_tangent())
          Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(
            matrix().block(block, block))
            .bottomRightCorner<3, 3>() -= .5 * cross_matrix(load.tail<3>());
      }
  }



  void
  System::eliminate_fixed(const std::vector<double> &increments)
  {
    const auto &owned = numbering.owned_blocks();
    for (unsigned int row = 0; row < owned.size(); ++row)
      {
        const unsigned int row_block = owned[row];
        const unsigned int height    = numbering.size(row_block);
        const unsigned int row_dof   = numbering.first_dof(row_block);
        const auto        &columns   = matrix().columns(row);
        for (unsigned int c = 0; c < columns.size(); ++c)
          {
            if (!movement.has_fixed(row_block) &&
                !movement.has_fixed(columns[c]))
              continue;
            const unsigned int width      = numbering.size(columns[c]);
            const unsigned int column_dof = numbering.first_dof(columns[c]);
            double            *entries    = matrix().values(row, c);
            for (unsigned int i = 0; i < height; ++i)
              for (unsigned int j = 0; j < width; ++j)
                {
                  double &entry = entries[i * width + j];
                  if (movement.is_fixed(row_dof + i))
                    entry = row_dof + i == column_dof + j ? stiffness : 0.;
                  else if (movement.is_fixed(column_dof + j))
                    {
                      rhs[numbering.local_first_dof(row) + i] -=
                        entry * increments[column_dof + j];
                      entry = 0;
                    }
                }
          }
        for (unsigned int i = 0; i < height; ++i)
          if (movement.is_fixed(row_dof + i))
            rhs[numbering.local_first_dof(row) + i] =
              stiffness * increments[row_dof + i];
      }
  }



  void
  System::assemble(const State                 &state,
                   const Targets               &targets,
                   std::vector<ContactElement> &contacts)
  {
    assemble_all(state, targets, contacts, curvature);
    for (unsigned int i = 0; i < rhs.size(); ++i)
      rhs[i] = -sum.residual()[i];
    pending = movement.prescribed_increments(state, targets);
    eliminate_fixed(pending);
  }



  void
  System::assemble_residual(const State                 &state,
                            const Targets               &targets,
                            std::vector<ContactElement> &contacts)
  {
    assemble_all(state, targets, contacts, Curvature::none);
  }
} // namespace fiberloom
