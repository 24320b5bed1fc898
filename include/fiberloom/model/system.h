// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_model_system_h
#define fiberloom_model_system_h

#include <fiberloom/model/assembly.h>
#include <fiberloom/model/contact_term.h>
#include <fiberloom/model/plate_term.h>

#include <array>
#include <memory>
#include <vector>

namespace fiberloom
{
  /** Rigid motions, the owned parts: three translations, three rotations. */
  using RigidModes = std::array<std::vector<double>, 6>;

  /**
   * The equations of one stage, with the nodes held by bodies eliminated: the
   * sum of its terms, which are fibers, matrix and junctions where there are
   * some, plates and contacts, and of the loads on nodes and bodies. Each rank
   * evaluates what touches the blocks it owns, so nothing is sent while
   * assembling.
   *
   * Unknowns are increments: of a free node its nine dofs, of a held node the
   * components along its attachment's frame, of a body the displacement of
   * its reference point and a rotation vector about it.
   */
  class System
  {
  public:
    /** @p composite : null where there is no matrix. */
    System(const FiberMesh &mesh,
           const Supports  &supports,
           MPI_Comm         comm,
           const Composite *composite = nullptr);

    /**
     * From here on, only terms and contacts that touch one of @p blocks , all
     * if there are none, in a matrix of its own: right in the rows of these
     * blocks, and no use in others. Energies lack what contacts elsewhere
     * store. reinit() has to follow.
     */
    void
    restrict_to(const std::vector<char> &blocks);

    /** Sets the pattern for terms and @p contacts . */
    void
    reinit(const std::vector<ContactElement> &contacts);

    /**
     * Assembles residual and tangent at @p state under the loads of
     * @p targets , whose dead forces on nodes count among what bodies have to
     * balance. Prescribed dofs of the bodies have the increment that leads to
     * @p targets , which enters the right hand side through the tangent. Stores
     * forces in @p contacts .
     */
    void
    assemble(const State                 &state,
             const Targets               &targets,
             std::vector<ContactElement> &contacts);

    /**
     * Adds the stiffness_added of @p contacts to the system that was assembled
     * last: to the tangent, and with the force that open ones get by it to the
     * right hand side.
     */
    void
    add_stiffness(const State                       &state,
                  const std::vector<ContactElement> &contacts);

    /**
     * Sets which part of the Hessian is assembled of fibers, and of contacts
     * whose points follow them.
     */
    void
    set_curvature(const Curvature of_energy)
    {
      curvature = of_energy;
    }

    /** Energy lost by terms in the increment that ends at @p state [N mm]. */
    double
    dissipation(const State &state) const;

    /** Contact with plates, which have friction of their own. */
    PlateTerm &
    plates()
    {
      return *plate_term;
    }

    /** Assembles the residual alone. Stores forces in @p contacts . */
    void
    assemble_residual(const State                 &state,
                      const Targets               &targets,
                      std::vector<ContactElement> &contacts);

    /** Potential of terms and contacts [N mm], summed over the ranks. */
    double
    energy(const State                       &state,
           const std::vector<ContactElement> &contacts) const;

    /**
     * The part of energy() that can be regained: without what friction loses
     * [N mm].
     */
    double
    stored_energy(const State                       &state,
                  const std::vector<ContactElement> &contacts) const;

    /**
     * Work of the dead loads from @p before to @p after [N mm]; that of a
     * moment, which has no potential, to first order.
     */
    double
    load_work(const Targets &targets,
              const State   &before,
              const State   &after) const;

    /** Whether the loads have a potential: moments on bodies that can turn
     * about more than one axis have none. */
    bool
    has_potential(const Targets &targets) const;

    /** Largest unbalanced force over the free dofs [N]; moments count over the
     * radius. */
    double
    residual_norm() const;

    /**
     * The block of the first node or body whose dofs have residual_norm(), see
     * BlockLayout.
     */
    unsigned int
    most_unbalanced() const;

    /** Largest force inside an element or a cell or from outside, a scale for
     * the residual [N]. */
    double
    force_scale() const;

    /**
     * What each body has to exert on fibers and matrix: three forces [N] and
     * three moments about its reference point [N mm].
     */
    const std::vector<BodyVector> &
    reactions() const
    {
      return body_reactions;
    }

    /** What rounding of the positions makes of the forces in an element [N]. */
    double
    rounding_force() const
    {
      return rounding;
    }

    /**
     * The tangent that was assembled last, see BlockMatrix for its units; that
     * of restrict_to() where the system is restricted.
     */
    BlockMatrix &
    matrix()
    {
      return sum.matrix();
    }

    /**
     * Right hand side by owned dofs: forces [N] and moments on bodies [N mm].
     */
    const std::vector<double> &
    right_hand_side() const
    {
      return rhs;
    }

    /**
     * What is out of balance by owned dofs [N], [N mm]; zero where they are
     * fixed.
     */
    std::vector<double>
    free_residual() const;

    /**
     * The increment of all dofs on every rank, prescribed increments included
     * [mm], [rad], from @p owned_solution of the linear system, which has the
     * owned dofs. Collective.
     */
    Eigen::VectorXd
    gather(const std::vector<double> &owned_solution) const;

    /**
     * The owned increments that move all fibers and free bodies as one rigid
     * body, from the reference placement: six vectors of as many entries as
     * there are owned dofs.
     */
    RigidModes
    rigid_modes() const;

    /** How increments move fibers and bodies. */
    const Motion &
    motion() const
    {
      return movement;
    }

    const FiberMesh &
    fiber_mesh() const
    {
      return mesh;
    }

    const BlockLayout &
    layout() const
    {
      return numbering;
    }

    /** Diagonal entry of fixed dofs, and scale of shifts [N/mm]. */
    double
    stiffness_scale() const
    {
      return stiffness;
    }

  private:
    void
    assemble_all(const State                 &state,
                 const Targets               &targets,
                 std::vector<ContactElement> &contacts,
                 const Curvature              curvature);

    /** Couplings of all terms but contacts, by owned rows. */
    std::vector<std::vector<unsigned int>>
    fixed_couplings() const;

    /** What bodies have to exert, from the residual without loads on them. */
    void
    sum_reactions();

    /** Largest unbalanced force of each owned block [N]. */
    std::vector<double>
    unbalanced_forces() const;

    void
    eliminate_fixed(const std::vector<double> &increments);

    void
    add_node_forces(const Targets &targets);

    void
    add_body_loads(const Targets &targets);

    const FiberMesh              &mesh;
    const Supports               &supports;
    const Composite              *composite; // or null
    const std::vector<NodeImage> &originals;
    BlockLayout                   numbering;
    Motion                        movement;
    BlockMatrix                   system_matrix, restricted_matrix;
    Assembly                      sum;

    // Contacts, which come and go, are apart from those that stay.
    std::vector<std::unique_ptr<Term>> terms;
    PlateTerm                         *plate_term; // among these
    ContactTerm                        contact_term;

    double                                 stiffness;
    Curvature                              curvature = Curvature::exact;
    std::vector<std::vector<unsigned int>> fixed_pattern; // owned rows

    std::vector<double>     rhs; // owned dofs
    std::vector<BodyVector> body_reactions;
    double                  rounding = 0;
    std::vector<double>     pending; // prescribed increments, by dof of bodies
    std::unique_ptr<Epetra_Map>    owned_map, everything;
    std::unique_ptr<Epetra_Import> importer;
  };
} // namespace fiberloom

#endif
