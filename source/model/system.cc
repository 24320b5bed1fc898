// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/model/element_groups.h>
#include <fiberloom/model/held_nodes.h>
#include <fiberloom/model/scatter.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>

#include <Epetra_LocalMap.h>
#include <Epetra_Vector.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace fiberloom
{
  using dealii::Utilities::MPI::max;
  using dealii::Utilities::MPI::sum;

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

    constexpr double rounding_errors =
      10 * std::numeric_limits<double>::epsilon();
    constexpr double rounding_errors_of_sections =
      4 * std::numeric_limits<double>::epsilon();

    /** What rounding of the positions makes of the forces in a cell, through
     * the strain, or in a junction [N]. */
    double
    rounding_of_matrix(const Composite &composite)
    {
      const MatrixMesh &matrix = composite.matrix();
      const double modulus  = matrix.law().stiffness(Matrix3::Identity())(0, 0);
      const double size     = matrix.reference().lpNorm<Eigen::Infinity>();
      double       rounding = modulus * size * matrix.largest_slope();
      for (const JunctionElement &junction : composite.junctions())
        rounding = std::max(rounding, junction.spring() * size);
      return rounding_errors * rounding;
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
    , seen(mesh.with_images())
    , seen_nodes(mesh.images() ? mesh.images()->nodes :
                                 std::vector<NodeImage>())
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
    , stiffness(mesh.smallest_stiffness())
    , element_pattern(numbering.owned_blocks().size())
    , residual(numbering.n_owned_dofs())
    , rhs(residual.size())
    , body_reactions(supports.bodies.size(), BodyVector::Zero())
    , pending(numbering.n_dofs(), 0.)
  {
    const double size = mesh.reference().lpNorm<Eigen::Infinity>();
    for (const auto &line : mesh.lines())
      {
        const double axial_stiffness =
          line.young_modulus * M_PI * line.radius * line.radius;
        // Forces that widen and shear a section are those of an element's whole
        // length: in very slender fibers their rounding is larger.
        rounding = std::max({rounding,
                             rounding_errors * axial_stiffness * size *
                               line.n_nodes() / line.length,
                             rounding_errors_of_sections * axial_stiffness *
                               line.length / (line.n_elements * line.radius)});
      }
    if (composite != nullptr)
      rounding = std::max(rounding, rounding_of_matrix(*composite));

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



  void
  System::set_element_pattern()
  {
    const auto add = [this](std::vector<unsigned int> blocks) {
      if (supports.plates)
        blocks.push_back(numbering.body_block(supports.plates->body));
      append_bodies(movement, supports, numbering, originals, blocks);
      couple(numbering, blocks, element_pattern);
    };
    for (unsigned int e = 0; e < mesh.n_elements(); ++e)
      {
        const unsigned int n = mesh.first_node(e);
        add({n, n + 1, n + 2});
      }
    if (composite != nullptr)
      {
        for (unsigned int c = 0; c < composite->matrix().n_cells(); ++c)
          add(nodes_of_cell(*composite, c));
        for (const JunctionElement &junction : composite->junctions())
          add(nodes_of_junction(*composite, junction));
      }
    for (unsigned int b = 0; b < supports.bodies.size(); ++b)
      couple(numbering, {numbering.body_block(b)}, element_pattern);
    for (unsigned int n = 0; n < originals.size(); ++n)
      if (movement.is_image(n)) // unknowns that stay zero
        couple(numbering, {n}, element_pattern);
    sort_unique(element_pattern);
  }



  namespace
  {
    /** Of the contact's friction and, where its points follow, of the normal
     * contact; some may come twice. */
    void
    append_nodes(const FiberMesh           &mesh,
                 const ContactElement      &contact,
                 std::vector<unsigned int> &nodes)
    {
      for (unsigned int s = 0; s < 2; ++s)
        {
          for (unsigned int a = 0; a < 3; ++a)
            nodes.push_back(contact.first_nodes[s] + a);
          if (contact.following == ContactElement::Points::fixed)
            continue;
          const LineWeights weights(mesh.lines()[contact.fibers[s]],
                                    contact.u[s]);
          for (unsigned int a = 0; a < weights.n; ++a)
            nodes.push_back(weights.first_node + a);
        }
    }
  } // namespace



  void
  System::reinit(const std::vector<ContactElement> &contacts)
  {
    if (system_matrix.pattern_version() == 0)
      set_element_pattern();

    std::vector<unsigned int> blocks;
    auto                      pattern = element_pattern;
    for (const ContactElement &contact : contacts)
      {
        blocks.clear();
        append_nodes(seen, contact, blocks);
        std::sort(blocks.begin(), blocks.end());
        blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
        append_bodies(movement, supports, numbering, seen_nodes, blocks);
        couple(numbering, blocks, pattern);
      }
    sort_unique(pattern);
    system_matrix.reinit(std::move(pattern));
  }



  bool
  System::touches_owned(const unsigned int           *nodes,
                        const unsigned int            n,
                        const std::vector<NodeImage> &images) const
  {
    const auto owns_body = [this](const unsigned int body) {
      return numbering.local_block(numbering.body_block(body)) >= 0;
    };
    for (unsigned int a = 0; a < n; ++a)
      {
        unsigned int node = nodes[a];
        if (node < images.size())
          {
            if (images[node].periods != std::array<int, 2>() &&
                owns_body(supports.cell->body))
              return true;
            node = images[node].node;
          }
        if (numbering.local_block(node) >= 0)
          return true;
        const int i = movement.attachment(node);
        if (i >= 0 && owns_body(supports.attachments[i].body))
          return true;
      }
    return false;
  }



  template <bool with_tangent>
  void
  System::assemble_all(const State                 &state,
                       const Targets               &targets,
                       std::vector<ContactElement> &contacts)
  {
    std::fill(residual.begin(), residual.end(), 0.);
    if constexpr (with_tangent)
      {
        system_matrix.set_zero();
        system_matrix.remove_outer_products();
      }

    double       scale = 0;
    ElementGroup group;
    for (unsigned int e = 0; e < mesh.n_elements(); ++e)
      {
        const unsigned int first = mesh.first_node(e);
        group.nodes              = {{first, first + 1, first + 2}};
        if (!touches_owned(group.nodes.data(), 3, originals))
          continue;
        const auto q = mesh.element_dofs(state.q, e);
        mesh.visit_element(e, state.fibers, [&](const BeamElement &element) {
          if constexpr (with_tangent)
            element.residual_and_tangent(q,
                                         group.residual,
                                         group.tangent,
                                         curvature);
          else
            element.residual(q, group.residual);
        });
        scale = std::max(scale, group.residual.lpNorm<Eigen::Infinity>());
        scatter<with_tangent>(state, group, originals);
      }
    largest_force = scale;
    if (composite != nullptr)
      {
        add_matrix<with_tangent>(state);
        add_junctions<with_tangent>(state);
      }
    largest_force = max(largest_force, numbering.communicator());

    const DofVector q = mesh.with_images(state.q);
    PotentialGroup  potential;
    for (ContactElement &contact : contacts)
      {
        if (contact.following != ContactElement::Points::fixed)
          {
            add_contact<with_tangent>(state, q, contact, potential);
            continue;
          }
        ContactGroup      contact_group(contact);
        const SectionPair x    = section_pair(contact, q);
        const bool        mine = touches_owned(contact_group.nodes.data(),
                                        contact_group.n_nodes,
                                        seen_nodes);
        const bool        active =
          evaluate_contact(contact,
                           x,
                           contact_group.residual,
                           with_tangent && mine ? &contact_group.tangent :
                                                  nullptr);
        if (active && mine)
          scatter<with_tangent>(state, contact_group, seen_nodes);
      }

    if (supports.plates)
      add_plates<with_tangent>(state);
    add_node_forces<with_tangent>(state, targets);

    for (unsigned int b = 0; b < body_reactions.size(); ++b)
      {
        body_reactions[b].setZero();
        if (const int local = numbering.local_block(numbering.body_block(b));
            local >= 0)
          body_reactions[b] = Eigen::Map<const BodyVector>(
            residual.data() + numbering.local_first_dof(local));
      }
    if (!body_reactions.empty())
      MPI_Allreduce(MPI_IN_PLACE,
                    body_reactions.data(),
                    6 * body_reactions.size(),
                    MPI_DOUBLE,
                    MPI_SUM,
                    numbering.communicator());
    add_body_loads<with_tangent>(targets);
  }



  template <bool with_tangent>
  void
  System::add_contact(const State     &state,
                      const DofVector &q,
                      ContactElement  &contact,
                      PotentialGroup  &normal)
  {
    // All ranks need the forces, those that own one of its nodes the rest.
    normal.nodes.clear();
    append_nodes(seen, contact, normal.nodes);
    const bool mine =
      touches_owned(normal.nodes.data(), normal.nodes.size(), seen_nodes);
    const bool active =
      evaluate_normal(contact,
                      seen,
                      q,
                      normal.potential,
                      with_tangent && mine ? curvature : Curvature::none);
    if (active && mine)
      {
        normal.set_nodes();
        scatter<with_tangent>(state, normal, seen_nodes);
      }
    contact.friction_force = Vector3::Zero();
    contact.slip           = Vector3::Zero();
    if (!(contact.friction_limit > 0))
      return;
    ContactGroup friction(contact);
    evaluate_friction(contact,
                      section_pair(contact, q),
                      friction.residual,
                      with_tangent && mine ? &friction.tangent : nullptr);
    if (mine)
      scatter<with_tangent>(state, friction, seen_nodes);
    if (with_tangent && mine && active)
      couple_limit(state, contact, friction, normal);
  }



  void
  System::add_stiffness(const State                       &state,
                        const std::vector<ContactElement> &contacts)
  {
    std::vector<double> balance(residual.size(), 0.);
    residual.swap(balance);
    const DofVector q = mesh.with_images(state.q);
    PotentialGroup  normal;
    for (const ContactElement &contact : contacts)
      {
        if (contact.stiffness_added == 0)
          continue;
        ContactElement predicted = contact;
        if (!evaluate_normal(predicted, seen, q, normal.potential, curvature))
          continue;
        normal.set_nodes();
        if (touches_owned(normal.nodes.data(), normal.nodes.size(), seen_nodes))
          scatter<true>(state, normal, seen_nodes);
      }
    for (unsigned int i = 0; i < rhs.size(); ++i)
      rhs[i] -= residual[i];
    residual.swap(balance);
    eliminate_fixed(pending);
  }



  void
  System::couple_limit(const State          &state,
                       const ContactElement &contact,
                       const ContactGroup   &friction,
                       const PotentialGroup &normal)
  {
    const unsigned int n = normal.nodes.size();
    const double       coefficient =
      contact.friction_limit / std::max(contact.normal_force_before, 1e-300);
    HeldGroup rows(normal.nodes.data(),
                   n,
                   movement.attachments(),
                   supports,
                   numbering,
                   seen_nodes),
      columns(rows);
    for (unsigned int a = 0; a < n; ++a)
      {
        Eigen::Matrix<double, 9, 1> force = Eigen::Matrix<double, 9, 1>::Zero();
        for (unsigned int b = 0; b < friction.n_nodes; ++b)
          if (friction.nodes[b] == normal.nodes[a] &&
              b / 3 == normal.potential.fiber[a])
            force = friction.force(b) / contact.friction_limit;
        rows.set_force(a, force);
        columns.set_force(a,
                          coefficient * normal.potential.value[a] *
                            normal.potential.force_slope.segment<9>(
                              9 * normal.potential.fiber[a]));
      }
    add_product(state, rows, columns);
  }



  void
  System::add_product(const State &state, HeldGroup &rows, HeldGroup &columns)
  {
    rows.transform(state.q, state.placements, false);
    columns.transform(state.q, state.placements, false);
    std::vector<unsigned int> blocks;
    std::vector<double>       row, column;
    for (unsigned int a = 0; a < rows.n_blocks(); ++a)
      {
        const unsigned int block = rows.block(a);
        blocks.push_back(block);
        const Eigen::VectorXd r = rows.force(a), c = columns.force(a);
        for (unsigned int i = 0; i < r.size(); ++i)
          {
            const bool fixed =
              movement.is_fixed(numbering.first_dof(block) + i);
            row.push_back(fixed ? 0 : r[i]);
            column.push_back(fixed ? 0 : c[i]);
          }
      }
    system_matrix.add_outer_product(
      blocks,
      Eigen::Map<const Eigen::VectorXd>(row.data(), row.size()),
      Eigen::Map<const Eigen::VectorXd>(column.data(), column.size()));
  }



  template <bool with_tangent>
  void
  System::add_matrix(const State &state)
  {
    const MatrixMesh     &matrix    = composite->matrix();
    const Eigen::VectorXd positions = composite->positions(state.q);
    MixedGroup            group;
    for (unsigned int c = 0; c < matrix.n_cells(); ++c)
      {
        group.set_nodes(nodes_of_cell(*composite, c), numbering);
        if (!touches_owned(group.nodes.data(), group.nodes.size(), originals))
          continue;
        const Eigen::VectorXd x = matrix.cell_positions(positions, c);
        if constexpr (with_tangent)
          matrix.element(c).residual_and_tangent(x,
                                                 group.residual,
                                                 group.tangent);
        else
          group.residual = matrix.element(c).residual(x);
        largest_force =
          std::max(largest_force, group.residual.lpNorm<Eigen::Infinity>());
        scatter<with_tangent>(state, group, originals);
      }
  }



  template <bool with_tangent>
  void
  System::add_junctions(const State &state)
  {
    for (unsigned int j = 0; j < composite->junctions().size(); ++j)
      {
        const JunctionGroup group(*composite, j, state.q, numbering);
        if (!touches_owned(group.nodes.data(), group.nodes.size(), originals))
          continue;
        const bool held = std::any_of(group.nodes.begin(),
                                      group.nodes.end(),
                                      [this](const unsigned int node) {
                                        return movement.attachment(node) >= 0 ||
                                               movement.is_image(node);
                                      });
        if (held)
          scatter<with_tangent>(state, group, originals);
        else
          scatter_diagonals<with_tangent>(group);
      }
  }



  template <bool with_tangent>
  void
  System::scatter_diagonals(const JunctionGroup &group)
  {
    for (unsigned int a = 0; a < group.nodes.size(); ++a)
      {
        const unsigned int row   = group.nodes[a];
        const int          local = numbering.local_block(row);
        if (local < 0)
          continue;
        double *forces = residual.data() + numbering.local_first_dof(local);
        for (unsigned int i = 0; i < group.size(a); ++i)
          forces[i] += group.weight(a, i / 3) * -group.fiber_force[i % 3];
        if constexpr (with_tangent)
          for (unsigned int b = 0; b < group.nodes.size(); ++b)
            {
              double *entries = system_matrix.block(row, group.nodes[b]);
              const unsigned int width = group.size(b);
              for (unsigned int i = 0; i < group.size(a); ++i)
                for (unsigned int v = 0; v < width / 3; ++v)
                  entries[i * width + 3 * v + i % 3] +=
                    group.stiffness_of(a, i / 3, b, v);
            }
      }
  }



  template <bool with_tangent>
  void
  System::add_node_forces(const State &state, const Targets &targets)
  {
    for (unsigned int n = 0; n < targets.node_forces.size(); ++n)
      {
        const NodeGroup group{{{n}}, targets.node_forces[n]};
        largest_force =
          std::max(largest_force, group.outer_force.lpNorm<Eigen::Infinity>());
        if (touches_owned(&n, 1, originals))
          scatter<with_tangent>(state, group, originals);
      }
  }



  template <bool with_tangent>
  void
  System::add_body_loads(const Targets &targets)
  {
    for (unsigned int b = 0; b < targets.bodies.size(); ++b)
      {
        const BodyVector &load = targets.bodies[b].load;
        largest_force          = std::max(
          {largest_force,
                    load.head<3>().lpNorm<Eigen::Infinity>(),
                    load.tail<3>().lpNorm<Eigen::Infinity>() / rotation_lever(mesh)});
        const unsigned int block = numbering.body_block(b);
        const int          local = numbering.local_block(block);
        if (local < 0)
          continue;
        Eigen::Map<BodyVector>(residual.data() +
                               numbering.local_first_dof(local)) -= load;
        // A moment fixed in space has no potential: as rotation vectors start
        // anew at each placement, the slope of the residual is unsymmetric.
        if constexpr (with_tangent)
          Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(
            system_matrix.block(block, block))
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
        const auto        &columns   = system_matrix.columns(row);
        for (unsigned int c = 0; c < columns.size(); ++c)
          {
            if (!movement.has_fixed(row_block) &&
                !movement.has_fixed(columns[c]))
              continue;
            const unsigned int width      = numbering.size(columns[c]);
            const unsigned int column_dof = numbering.first_dof(columns[c]);
            double            *entries    = system_matrix.values(row, c);
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
    assemble_all<true>(state, targets, contacts);
    for (unsigned int i = 0; i < rhs.size(); ++i)
      rhs[i] = -residual[i];
    pending = movement.prescribed_increments(state, targets);
    eliminate_fixed(pending);
  }



  void
  System::assemble_residual(const State                 &state,
                            const Targets               &targets,
                            std::vector<ContactElement> &contacts)
  {
    assemble_all<false>(state, targets, contacts);
  }
} // namespace fiberloom
