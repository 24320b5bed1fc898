// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_beams_fiber_mesh_h
#define fiberloom_beams_fiber_mesh_h

#include <fiberloom/base/vector_types.h>

#include <fiberloom/fabric/fiber_images.h>

#include <fiberloom/beams/beam_element.h>
#include <fiberloom/beams/fiber_history.h>
#include <fiberloom/beams/shape_functions.h>

#include <Eigen/Geometry>

#include <array>
#include <memory>
#include <vector>

namespace fiberloom
{
  /**
   * Centre line and section of a fiber at one abscissa, from its dofs; equation
   * [2] of the paper.
   */
  struct Section
  {
    Vector3 center;
    Vector3 center_derivative;  // by the parameter u, see FiberMesh
    Vector3 vector_1, vector_2; // r g1, r g2 [mm]

    /** Continuous over element ends, unlike the centre line's own tangent. */
    Vector3
    tangent() const
    {
      return vector_1.cross(vector_2).normalized();
    }
  };

  /** A place on a fiber: element of the mesh and xi in [-1, 1]. */
  struct ElementPoint
  {
    unsigned int element;
    double       xi;
  };

  /**
   * All fibers as chains of quadratic elements. Nodes are numbered fiber by
   * fiber, so are elements; node n has the dofs 9n .. 9n+8: x0, r g1, r g2.
   * The parameter u of a fiber runs from 0 to its number of elements.
   *
   * Contact sees the fibers of a periodic cell with their images, which are a
   * mesh of their own, see FiberImages, whose nodes are those of the cell moved
   * by whole periods. Without a cell it sees this mesh.
   */
  class FiberMesh
  {
  public:
    /** One fiber, as a piece of the mesh. */
    struct Line
    {
      unsigned int first_node;
      unsigned int first_element;
      unsigned int n_elements;
      unsigned int tow;
      double       radius;        // [mm]
      double       young_modulus; // [MPa]
      double       length;        // reference [mm]
      unsigned int period = 0;    // elements until it repeats itself, 0: never

      unsigned int
      n_nodes() const
      {
        return 2 * n_elements + 1;
      }
    };

    static constexpr unsigned int dofs_per_node = 9;

    /**
     * Makes elements of all @p fibers and, if they have a cell, of their
     * images. Throws InputError where an element is degenerate.
     */
    explicit FiberMesh(const FiberSet &fibers);

    const std::vector<Line> &
    lines() const
    {
      return fiber_lines;
    }

    unsigned int
    n_nodes() const
    {
      return reference_dofs.size() / dofs_per_node;
    }

    unsigned int
    n_elements() const
    {
      return beam_elements.size();
    }

    unsigned int
    fiber_of_element(const unsigned int element) const
    {
      return element_fibers[element];
    }

    /** The first of the three nodes of @p element ; the others follow it. */
    unsigned int
    first_node(const unsigned int element) const
    {
      const Line &line = fiber_lines[element_fibers[element]];
      return line.first_node + 2 * (element - line.first_element);
    }

    const BeamElement &
    element(const unsigned int e) const
    {
      return beam_elements[e];
    }

    /**
     * Calls @p visit with element @p e as @p history has left it, whole or
     * broken, and returns what it returns.
     */
    template <class Visitor>
    auto
    visit_element(const unsigned int  e,
                  const FiberHistory &history,
                  const Visitor      &visit) const
    {
      return history.is_broken(e) ? visit(beam_elements[e].broken()) :
                                    visit(beam_elements[e]);
    }

    /** Dofs of the stress-free placement, nine for each node [mm]. */
    const DofVector &
    reference() const
    {
      return reference_dofs;
    }

    /**
     * Dofs of the placement at the start, which need not be free of stress
     * [mm].
     */
    const DofVector &
    initial() const
    {
      return initial_dofs;
    }

    /**
     * The 27 dofs of @p element [mm]: nine of each of its nodes, start, middle,
     * end.
     */
    BeamElement::Vector
    element_dofs(const DofVector &q, const unsigned int element) const
    {
      return q.segment<27>(dofs_per_node * first_node(element));
    }

    /**
     * Whether an element of any fiber is folded at @p q , see BeamElement;
     * broken ones do not count.
     */
    bool
    is_folded(const DofVector &q, const FiberHistory &history) const;

    /**
     * Largest relative change of a section's width at a node, over all its
     * directions.
     */
    double
    largest_section_change(const DofVector &q) const;

    /**
     * The fibers of a cell as contact sees them; null where there is no cell.
     */
    const FiberImages *
    images() const;

    /** The mesh that contact sees. */
    const FiberMesh &
    with_images() const;

    /**
     * The dofs of the mesh that contact sees, where those of this mesh are
     * @p q .
     */
    DofVector
    with_images(const DofVector &q) const;

    /** What each node of this mesh is the image of; empty without a cell. */
    const std::vector<NodeImage> &
    originals() const
    {
      return original_nodes;
    }

    /**
     * Distance of two places @p u and @p v of a fiber, in elements; images
     * count as the same place.
     */
    double
    distance(const unsigned int fiber, const double u, const double v) const;

    /** The place of parameter @p u on a fiber; @p u is clamped to the fiber. */
    ElementPoint
    locate(const unsigned int fiber, const double u) const;

    /** The parameter u of its fiber at @p point , see locate(). */
    double
    parameter(const ElementPoint &point) const
    {
      return point.element -
             fiber_lines[element_fibers[point.element]].first_element +
             .5 * (point.xi + 1);
    }

    /**
     * Centre line and section of a fiber at @p point where the dofs are @p q .
     */
    Section
    section(const DofVector &q, const ElementPoint &point) const;

    /** Smallest radius of all fibers [mm]. */
    double
    smallest_radius() const
    {
      return radii[0];
    }

    /** Largest radius of all fibers [mm]. */
    double
    largest_radius() const
    {
      return radii[1];
    }

    /** Smallest E r of all fibers, a scale of stiffness [N/mm]. */
    double
    smallest_stiffness() const
    {
      return stiffness_scale;
    }

  private:
    struct Seen;

    void
    add_images(const FiberSet &fibers);

    std::vector<Line>         fiber_lines;
    std::vector<unsigned int> element_fibers;
    std::vector<BeamElement>  beam_elements;
    DofVector                 reference_dofs;
    DofVector                 initial_dofs;
    std::array<double, 2>     radii; // smallest, largest
    double                    stiffness_scale;

    std::shared_ptr<const Seen> seen; // null without a cell
    std::vector<NodeImage>      original_nodes;
  };
} // namespace fiberloom

#endif
