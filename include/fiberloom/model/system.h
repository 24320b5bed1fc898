// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_model_system_h
#define fiberloom_model_system_h

#include <fiberloom/contact/contact_element.h>
#include <fiberloom/contact/contact_potential.h>
#include <fiberloom/contact/contact_state.h>
#include <fiberloom/contact/plate_friction.h>

#include <fiberloom/coupling/rigid_body.h>

#include <fiberloom/model/block_matrix.h>
#include <fiberloom/model/motion.h>

#include <array>
#include <memory>
#include <vector>

namespace fiberloom
{
  /** Rigid motions, the owned parts: three translations, three rotations. */
  using RigidModes = std::array<std::vector<double>, 6>;

  struct JunctionGroup;
  struct ContactGroup;
  struct PotentialGroup;
  struct PlateGroup;
  struct PlateFrictionGroup;
  class HeldGroup;

  /**
   * The equations of one stage: fibers, contacts, rigid bodies and, where there
   * is one, matrix with its junctions, with the nodes held by bodies
   * eliminated. Each rank evaluates what touches the blocks it owns, so nothing
   * is sent while assembling.
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

    /** Sets the pattern for elements and @p contacts . */
    void
    reinit(const std::vector<ContactElement> &contacts);

    /**
     * Residual and tangent at @p state under the loads of @p targets , whose
     * dead forces on nodes count among what bodies have to balance.
     * Prescribed dofs of the bodies have
     * the increment that leads to @p targets , which enters the right hand
     * side through the tangent. Stores forces in @p contacts .
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

    /** Of fibers, and of contacts whose points follow them, in what is
     * assembled. */
    void
    set_curvature(const Curvature of_energy)
    {
      curvature = of_energy;
    }

    /** Friction on plates, if there are some: particles and limits from @p
     * state , slip from what @p history is of, when fibers were at @p q_before
     * . */
    void
    update_plates(const State                     &state,
                  const DofVector                 &q_before,
                  const std::vector<PlateHistory> &history);

    /** As update_plates() has set it; empty where there is none. */
    const std::vector<PlateFriction> &
    plate_friction() const
    {
      return friction_on_plates;
    }

    void
    set_plate_friction(const std::vector<PlateFriction> &friction)
    {
      friction_on_plates = friction;
    }

    /** What plates have to remember of an increment that ends at @p state . */
    std::vector<PlateHistory>
    plate_history(const State &state) const;

    /** By friction on plates in the increment that ends at @p state [N mm]. */
    double
    plate_dissipation(const State &state) const;

    /** Residual alone. */
    void
    assemble_residual(const State                 &state,
                      const Targets               &targets,
                      std::vector<ContactElement> &contacts);

    /** Potential of fibers, contacts, matrix and junctions [N mm], summed over
     * the ranks. */
    double
    energy(const State                       &state,
           const std::vector<ContactElement> &contacts) const;

    /** The part of it that can be regained: without what friction loses. */
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

    /** The first node or body whose dofs have it, see BlockLayout. */
    unsigned int
    most_unbalanced() const;

    /** Largest force inside a fiber element or from outside, a scale for the
     * residual [N]. */
    double
    force_scale() const;

    /** What each body has to exert on fibers and matrix [N], [N mm]. */
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

    BlockMatrix &
    matrix()
    {
      return system_matrix;
    }

    /** Right hand side in the order of the owned dofs. */
    const std::vector<double> &
    right_hand_side() const
    {
      return rhs;
    }

    /** What is out of balance, the owned dofs; zero where they are fixed. */
    std::vector<double>
    free_residual() const;

    /**
     * The whole increment from the solution of the linear system (owned part)
     * on every rank, prescribed increments included.
     */
    Eigen::VectorXd
    gather(const std::vector<double> &owned_solution) const;

    /** The owned increments that move all fibers and free bodies as one rigid
     * body, from the reference placement. */
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
    template <bool with_tangent>
    void
    assemble_all(const State                 &state,
                 const Targets               &targets,
                 std::vector<ContactElement> &contacts);

    /** Of one whose points follow the fibers. */
    template <bool with_tangent>
    void
    add_contact(const State     &state,
                const DofVector &q, // of all that is seen
                ContactElement  &contact,
                PotentialGroup  &normal);

    void
    couple_limit(const State          &state,
                 const ContactElement &contact,
                 const ContactGroup   &friction,
                 const PotentialGroup &normal);

    /** Adds the product of two vectors, given as forces of the same nodes, to
     * products of the tangent. */
    void
    add_product(const State &state, HeldGroup &rows, HeldGroup &columns);

    template <bool with_tangent>
    void
    add_matrix(const State &state);

    template <bool with_tangent>
    void
    add_junctions(const State &state);

    template <bool with_tangent>
    void
    scatter_diagonals(const JunctionGroup &group);

    double
    matrix_energy(const State &state) const;

    template <bool with_tangent>
    void
    add_plates(const State &state);

    /** This rank's part. */
    double
    plate_energy(const State &state) const;

    template <bool with_tangent>
    void
    add_plate_friction(const State &state, const PlateGroup &group);

    void
    couple_plate_limit(const State              &state,
                       const PlateGroup         &normal,
                       const PlateFrictionGroup &friction);

    /** Calls @p visit with contact, heights and group of each section and each
     * plate. */
    template <class Visitor>
    void
    visit_plate_stations(const State &state, const Visitor &visit) const;

    void
    set_element_pattern();

    /** @p images : what the nodes of @p group are images of; empty where they
     * are nodes of the system. So for touches_owned(). */
    template <bool with_tangent, class Group>
    void
    scatter(const State                  &state,
            const Group                  &group,
            const std::vector<NodeImage> &images = {});

    /** Of a node that contact sees. */
    unsigned int
    original(const unsigned int node) const
    {
      return seen_nodes.empty() ? node : seen_nodes[node].node;
    }

    bool
    touches_owned(const unsigned int           *nodes,
                  const unsigned int            n,
                  const std::vector<NodeImage> &images = {}) const;

    /** Largest unbalanced force of each owned block [N]. */
    std::vector<double>
    unbalanced_forces() const;

    void
    eliminate_fixed(const std::vector<double> &increments);

    template <bool with_tangent>
    void
    add_node_forces(const State &state, const Targets &targets);

    template <bool with_tangent>
    void
    add_body_loads(const Targets &targets);

    const FiberMesh              &mesh;
    const FiberMesh              &seen; // by contact
    const std::vector<NodeImage>  seen_nodes;
    const Supports               &supports;
    const Composite              *composite; // or null
    const std::vector<NodeImage> &originals;
    BlockLayout                   numbering;
    Motion                        movement;
    BlockMatrix                   system_matrix;

    double                                 stiffness;
    Curvature                              curvature = Curvature::exact;
    std::vector<std::vector<unsigned int>> element_pattern; // owned rows

    std::vector<double>        residual; // owned dofs
    std::vector<double>        rhs;
    std::vector<BodyVector>    body_reactions;
    std::vector<PlateFriction> friction_on_plates; // each section and plate
    double                     rounding      = 0;
    double                     largest_force = 0;
    std::vector<double> pending; // prescribed increments, by dof of bodies
    std::unique_ptr<Epetra_Map>    owned_map, everything;
    std::unique_ptr<Epetra_Import> importer;
  };
} // namespace fiberloom

#endif
