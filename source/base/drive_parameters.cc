// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/drive_parameters.h>
#include <fiberloom/base/parameter_catalogue.h>

namespace fiberloom
{
  void
  DriveParameters::declare(ParameterCatalogue &catalogue)
  {
    const Allowed functions =
      Allowed::text_like("three functions of t with semicolons between");

    catalogue.enter_section("Drive " + name);
    catalogue.add(
      "Ends",
      ends,
      "Points of fibers that the rigid body holds: fibers, counted from 0, "
      "and start, end, at a fraction of the length (the nearest node is "
      "taken), or whole for all nodes. warp and fill are all fibers of that "
      "family, or of the tows whose numbers follow.",
      Allowed::text_like("such as 0 start, 3-5 end, all at 0.5, 1 whole, "
                         "warp start, fill 2 end"));
    catalogue.add("Hold",
                  hold,
                  "How it holds them: clamped holds the axis' end and the "
                  "directions of the section; pinned the axis' end and the "
                  "rotation of the section about the axis; centers only the "
                  "axis' end.");
    catalogue.add(
      "Held",
      held,
      "What is held at each point, one by one, in place of Hold: x, y and z "
      "of the axis, along the axes of the sample as the body turns them; "
      "spin, the rotation of the section about the axis; tilt, the "
      "direction of the axis; radial, only its tilt towards or away from "
      "the body's reference point. Empty: as Hold "
      "says.",
      Allowed::text_like("any of " + all_names<PointHold>(" ") +
                         " with blanks between"));
    catalogue.add("Free",
                  free,
                  "Degrees of freedom of the body that are not prescribed; "
                  "rx is the rotation about x.",
                  Allowed::text_like("any of " + all_names<BodyDof>(" ") +
                                     " with blanks between"));
    catalogue.add("Matrix borders",
                  matrix_borders,
                  "Borders of the matrix that the body holds, with commas: " +
                    all_names<MatrixBorder>(", ") + ".",
                  Allowed::text_like("such as x start, top"));
    catalogue.add("Matrix held",
                  matrix_held,
                  "Displacements that it holds there. An edge goes with "
                  "the first drive that has it.",
                  Allowed::text_like("some of " + all_names<Component>(" ") +
                                     " with blanks between"));
    catalogue.add("Center",
                  center,
                  "Reference point of the body at the start of the stage "
                  "[mm], about which it turns and to which moments refer. "
                  "Empty: the mean of the points that it holds.",
                  Allowed::text_like("three numbers x y z with blanks "
                                     "between"));
    catalogue.add("Translation",
                  translation,
                  "Displacement of the body's reference point [mm], 0 at "
                  "the start.",
                  functions);
    catalogue.add("Rotation",
                  rotation,
                  "Rotation vector of the body [rad] about its reference "
                  "point, 0 at the start; its length may be any number of "
                  "turns.",
                  functions);
    catalogue.add("Force",
                  force,
                  "Dead force [N] on those of the degrees of freedom x, y "
                  "and z that are free.",
                  functions);
    catalogue.add("Moment",
                  moment,
                  "Moment [N mm], fixed in space, on those of the degrees "
                  "of freedom rx, ry and rz that are free.",
                  functions);
    catalogue.leave_section();
  }
} // namespace fiberloom
