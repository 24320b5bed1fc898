// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_base_choices_h
#define fiberloom_base_choices_h

#include <fiberloom/base/exceptions.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace fiberloom
{
  /** The values of an entry that is one of a few, with their names there. */
  template <class Choice>
  using Choices = std::vector<std::pair<Choice, std::string>>;

  /**
   * The values of each such type with their names, in the order in which a user
   * reads them.
   */
  template <class Choice>
  extern const Choices<Choice> choices;

  template <class Choice>
  const std::string &
  name_of(const Choice choice)
  {
    return std::find_if(choices<Choice>.begin(),
                        choices<Choice>.end(),
                        [choice](const auto &known) {
                          return known.first == choice;
                        })
      ->second;
  }

  /** The choice that has this @p name ; nothing where there is none. */
  template <class Choice>
  std::optional<Choice>
  find_choice(const std::string &name)
  {
    const auto found =
      std::find_if(choices<Choice>.begin(),
                   choices<Choice>.end(),
                   [&name](const auto &known) { return known.second == name; });
    if (found == choices<Choice>.end())
      return {};
    return found->first;
  }

  /**
   * The choice that has this @p name . Throws InputError where there is none.
   */
  template <class Choice>
  Choice
  choice_of(const std::string &name)
  {
    const std::optional<Choice> found = find_choice<Choice>(name);
    if (!found)
      throw InputError("there is no choice \"" + name + "\"");
    return *found;
  }

  /** The names of all choices, with @p separator between. */
  template <class Choice>
  std::string
  all_names(const std::string &separator)
  {
    std::string names;
    for (const auto &known : choices<Choice>)
      names += (names.empty() ? "" : separator) + known.second;
    return names;
  }

  /** How the axial force grows with the stretch. */
  enum class AxialLaw
  {
    saint_venant_kirchhoff,
    linear
  };

  template <>
  inline const Choices<AxialLaw> choices<AxialLaw> = {
    {AxialLaw::saint_venant_kirchhoff, "Saint Venant-Kirchhoff"},
    {AxialLaw::linear, "linear"}};

  /** How fibers along one axis are arranged. */
  enum class Arrangement
  {
    none,
    bundle,
    strand
  };

  template <>
  inline const Choices<Arrangement> choices<Arrangement> = {
    {Arrangement::none, "none"},
    {Arrangement::bundle, "bundle"},
    {Arrangement::strand, "strand"}};

  /** What joins the points of a fiber. */
  enum class Joining
  {
    automatic,
    straight,
    smooth
  };

  template <>
  inline const Choices<Joining> choices<Joining> = {
    {Joining::automatic, "automatic"},
    {Joining::straight, "straight"},
    {Joining::smooth, "smooth"}};

  /** The shape of a fiber without stress. */
  enum class StressFree
  {
    as_given,
    straight
  };

  template <>
  inline const Choices<StressFree> choices<StressFree> =
    {{StressFree::as_given, "as given"}, {StressFree::straight, "straight"}};

  /** How a body holds a node of a fiber. */
  enum class Hold
  {
    clamped,   // centre, and the directions of both section vectors
    direction, // centre, and the direction of the first section vector
    pinned,    // centre, and no spin about the fiber's axis
    center,    // centre alone
    axial      // centre along the fiber's axis alone
  };

  // Those that a drive can ask for.
  template <>
  inline const Choices<Hold> choices<Hold> = {{Hold::clamped, "clamped"},
                                              {Hold::pinned, "pinned"},
                                              {Hold::center, "centers"}};

  /** What a body can hold of a point of a fiber, one by one. */
  enum class PointHold
  {
    x, // of the axis, along the axes of the sample
    y,
    z,
    spin,  // of the section about the axis
    tilt,  // the direction of the axis
    radial // its tilt towards or away from the body's reference point
  };

  template <>
  inline const Choices<PointHold> choices<PointHold> = {
    {PointHold::x, "x"},
    {PointHold::y, "y"},
    {PointHold::z, "z"},
    {PointHold::spin, "spin"},
    {PointHold::tilt, "tilt"},
    {PointHold::radial, "radial"}};

  /** A degree of freedom of a rigid body, numbered as in a BodyVector. */
  enum class BodyDof
  {
    x,
    y,
    z,
    rx, // the rotation about x
    ry,
    rz
  };

  template <>
  inline const Choices<BodyDof> choices<BodyDof> = {{BodyDof::x, "x"},
                                                    {BodyDof::y, "y"},
                                                    {BodyDof::z, "z"},
                                                    {BodyDof::rx, "rx"},
                                                    {BodyDof::ry, "ry"},
                                                    {BodyDof::rz, "rz"}};

  /** A component of a displacement. */
  enum class Component
  {
    x,
    y,
    z
  };

  template <>
  inline const Choices<Component> choices<Component> = {{Component::x, "x"},
                                                        {Component::y, "y"},
                                                        {Component::z, "z"}};

  /** A flat border of the layers of matrix: of each axis the start and the end.
   */
  enum class MatrixBorder
  {
    x_start,
    x_end,
    y_start,
    y_end,
    bottom,
    top
  };

  template <>
  inline const Choices<MatrixBorder> choices<MatrixBorder> = {
    {MatrixBorder::x_start, "x start"},
    {MatrixBorder::x_end, "x end"},
    {MatrixBorder::y_start, "y start"},
    {MatrixBorder::y_end, "y end"},
    {MatrixBorder::bottom, "bottom"},
    {MatrixBorder::top, "top"}};

  /** Whether a fiber can touch itself. */
  enum class SelfContact
  {
    automatic,
    always,
    never
  };

  template <>
  inline const Choices<SelfContact> choices<SelfContact> = {
    {SelfContact::automatic, "automatic"},
    {SelfContact::always, "true"},
    {SelfContact::never, "false"}};

  /** How a fabric is woven. */
  enum class WeavingPath
  {
    automatic,
    nested
  };

  template <>
  inline const Choices<WeavingPath> choices<WeavingPath> =
    {{WeavingPath::automatic, "automatic"}, {WeavingPath::nested, "nested"}};

  /** The tows of a fabric along which something runs. */
  enum class Direction
  {
    warp,
    fill
  };

  template <>
  inline const Choices<Direction> choices<Direction> =
    {{Direction::warp, "warp"}, {Direction::fill, "fill"}};

  /** What becomes of the direction that does not lead. */
  enum class OtherDirection
  {
    strained,
    free
  };

  template <>
  inline const Choices<OtherDirection> choices<OtherDirection> =
    {{OtherDirection::strained, "strained"}, {OtherDirection::free, "free"}};

  /** Where there is matrix. */
  enum class Layers
  {
    none,
    upper,
    lower,
    both,
    filled
  };

  template <>
  inline const Choices<Layers> choices<Layers> = {{Layers::none, "none"},
                                                  {Layers::upper, "upper"},
                                                  {Layers::lower, "lower"},
                                                  {Layers::both, "both"},
                                                  {Layers::filled, "filled"}};

  /** The law of a matrix at large strains. */
  enum class MatrixLaw
  {
    saint_venant_kirchhoff,
    neo_hooke
  };

  template <>
  inline const Choices<MatrixLaw> choices<MatrixLaw> = {
    {MatrixLaw::saint_venant_kirchhoff, "Saint Venant-Kirchhoff"},
    {MatrixLaw::neo_hooke, "neo-Hooke"}};

  /** How equilibrium is found where fibers touch. */
  enum class Loops
  {
    newton,
    nested
  };

  template <>
  inline const Choices<Loops> choices<Loops> = {{Loops::newton, "newton"},
                                                {Loops::nested, "nested"}};

  /** What preconditions linear systems. */
  enum class Preconditioning
  {
    automatic,
    double_factor,
    single_factor,
    rigid_sections,
    blocks,
    multigrid
  };

  template <>
  inline const Choices<Preconditioning> choices<Preconditioning> = {
    {Preconditioning::automatic, "automatic"},
    {Preconditioning::double_factor, "double factor"},
    {Preconditioning::single_factor, "single factor"},
    {Preconditioning::rigid_sections, "rigid sections"},
    {Preconditioning::blocks, "blocks"},
    {Preconditioning::multigrid, "multigrid"}};

  /** Tows that a slice cuts along. */
  enum class Slices
  {
    warp,
    fill,
    both,
    none
  };

  template <>
  inline const Choices<Slices> choices<Slices> = {{Slices::warp, "warp"},
                                                  {Slices::fill, "fill"},
                                                  {Slices::both, "both"},
                                                  {Slices::none, "none"}};

  /** A file for other programs. */
  enum class Export
  {
    surface,
    voxels,
    abaqus,
    paths,
    texgen,
    fibers
  };

  template <>
  inline const Choices<Export> choices<Export> = {{Export::surface, "surface"},
                                                  {Export::voxels, "voxels"},
                                                  {Export::abaqus, "abaqus"},
                                                  {Export::paths, "paths"},
                                                  {Export::texgen, "texgen"},
                                                  {Export::fibers, "fibers"}};
} // namespace fiberloom

#endif
