// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/fabric/fiber_images.h>

#include <fiberloom/output/canvas.h>
#include <fiberloom/output/fiber_samples.h>
#include <fiberloom/output/section_skin.h>
#include <fiberloom/output/weave_picture.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <vector>

namespace fiberloom
{
  namespace
  {
    constexpr unsigned int largest_side      = 1600; // in pixels
    constexpr unsigned int picture_intervals = 4;
    constexpr unsigned int picture_around    = 16;
    constexpr double       neighbors_lighter = .6;

    const Color matrix_color{{{.84, .86, .82}}};

    /** Parallel projection; rows: right, down, away from the eye. */
    Matrix3
    oblique_axes()
    {
      const Vector3 away  = Vector3(-.38, .80, -.78).normalized();
      const Vector3 right = away.cross(Vector3::UnitZ()).normalized();
      Matrix3       axes;
      axes.row(0) = right;
      axes.row(1) = away.cross(right);
      axes.row(2) = away;
      return axes;
    }

    /** None for the sample itself, which comes first, and those of a cell to
     * its neighbors [mm]. */
    std::vector<Vector3>
    shifts_of_cells(const FiberSet  &fibers,
                    const FiberMesh &mesh,
                    const DofVector &q,
                    const Neighbors  neighbors)
    {
      std::vector<Vector3> shifts = {Vector3::Zero()};
      if (!fibers.cell || neighbors == Neighbors::hidden)
        return shifts;
      std::array<Vector3, 2> periods;
      for (const FiberMesh::Line &line : mesh.lines())
        {
          const unsigned int first = FiberMesh::dofs_per_node * line.first_node,
                             last  = first + FiberMesh::dofs_per_node *
                                              (line.n_nodes() - 1);
          periods[direction(fibers.tows[line.tow])] =
            q.segment<3>(last) - q.segment<3>(first);
        }
      for (const int i : {-1, 0, 1})
        for (const int j : {-1, 0, 1})
          if (i != 0 || j != 0)
            shifts.push_back(i * periods[0] + j * periods[1]);
      return shifts;
    }

    /** From millimetres to pixels. */
    class PictureView
    {
    public:
      PictureView(const FiberMesh            &mesh,
                  const DofVector            &q,
                  const Composite            *composite,
                  const std::vector<Vector3> &shifts)
        : axes(oblique_axes())
      {
        low.setConstant(1e300);
        Vector3    high    = -low;
        double     thick   = 0;
        const auto include = [&](const Vector3 &point) {
          const Vector3 p = axes * point;
          low             = low.cwiseMin(p);
          high            = high.cwiseMax(p);
        };
        for (const Vector3 &shift : shifts)
          for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
            include(q.segment<3>(FiberMesh::dofs_per_node * n) + shift);
        if (composite != nullptr)
          for (unsigned int n = 0; n < composite->matrix().n_nodes(); ++n)
            include(composite->positions(q).segment<3>(3 * n));
        for (const auto &line : mesh.lines())
          thick = std::max(thick, line.radius);
        const double margin =
          1.5 * thick + .02 * (high - low).head<2>().maxCoeff();
        low.array() -= margin;
        high.array() += margin;

        scale  = largest_side / (high - low).head<2>().maxCoeff();
        width  = std::max(1., scale * (high[0] - low[0]));
        height = std::max(1., scale * (high[1] - low[1]));
      }

      Canvas::Corner
      corner(const Vector3 &point, const Vector3 &normal) const
      {
        Vector3 turned = axes * normal;
        turned[2]      = -turned[2];
        return {scale * (axes * point - low), turned};
      }

      Matrix3      axes;
      Vector3      low;
      double       scale;
      unsigned int width, height;
    };

    /** Draws one object. */
    struct Brush
    {
      Canvas            &canvas;
      const PictureView &view;
      const Color       &color;
      const int          object;

      void
      draw(const std::array<Canvas::Corner, 3> &triangle) const
      {
        canvas.draw(triangle, color, object);
      }
    };

    void
    draw_skin(const Brush &brush, const SectionSkin &skin)
    {
      const auto corner = [&](const unsigned int i) {
        return brush.view.corner(skin.points[i], skin.normals[i]);
      };
      for (unsigned int i = 0; i + 1 < skin.n_rings; ++i)
        for (unsigned int j = 0; j < skin.n_around; ++j)
          {
            const auto face = skin.face(i, j);
            brush.draw({{corner(face[0]), corner(face[1]), corner(face[2])}});
            brush.draw({{corner(face[0]), corner(face[2]), corner(face[3])}});
          }
    }

    void
    draw_end(const Brush       &brush,
             const SectionSkin &skin,
             const Section     &section,
             const unsigned int ring)
    {
      const Vector3 normal =
        ring == 0 ? Vector3(-section.tangent()) : section.tangent();
      const auto corner = [&](const unsigned int j) {
        return brush.view.corner(
          skin.points[ring * skin.n_around + j % skin.n_around], normal);
      };
      for (unsigned int j = 0; j < skin.n_around; ++j)
        brush.draw({{brush.view.corner(section.center, normal),
                     corner(j),
                     corner(j + 1)}});
    }

    bool
    is_shown(const Eigen::VectorXd &rest)
    {
      Vector3 middle = Vector3::Zero();
      for (unsigned int v = 0; v < 8; ++v)
        middle += rest.segment<3>(3 * v) / 8;
      return middle.z() < 0 || middle.y() > 0;
    }

    /** The six faces of each cell between its corners, which come first. */
    void
    draw_matrix(Canvas            &canvas,
                const PictureView &view,
                const Composite   &composite,
                const DofVector   &q,
                const int          first_object)
    {
      constexpr std::array<std::array<unsigned int, 4>, 6> faces{
        {{{0, 2, 6, 4}},
         {{1, 3, 7, 5}},
         {{0, 1, 5, 4}},
         {{2, 3, 7, 6}},
         {{0, 1, 3, 2}},
         {{4, 5, 7, 6}}}};
      const MatrixMesh     &matrix    = composite.matrix();
      const Eigen::VectorXd positions = composite.positions(q);
      for (unsigned int c = 0; c < matrix.n_cells(); ++c)
        {
          if (!is_shown(matrix.cell_positions(matrix.reference(), c)))
            continue;
          const Eigen::VectorXd x      = matrix.cell_positions(positions, c);
          const auto            corner = [&](const unsigned int v) {
            return Vector3(x.segment<3>(3 * v));
          };
          const Vector3 middle = .5 * (corner(0) + corner(7));
          for (const auto &face : faces)
            {
              Vector3 normal = (corner(face[2]) - corner(face[0]))
                                 .cross(corner(face[3]) - corner(face[1]))
                                 .normalized();
              if (normal.dot(corner(face[0]) - middle) < 0)
                normal = -normal;
              for (const unsigned int half : {1, 2})
                canvas.draw({{view.corner(corner(face[0]), normal),
                              view.corner(corner(face[half]), normal),
                              view.corner(corner(face[half + 1]), normal)}},
                            matrix_color,
                            first_object + c);
            }
        }
    }
  } // namespace



  std::string
  weave_picture(const FiberSet  &fibers,
                const FiberMesh &mesh,
                const DofVector &q,
                const Composite *composite,
                const Neighbors  neighbors)
  {
    const std::vector<Vector3> shifts =
      shifts_of_cells(fibers, mesh, q, neighbors);
    const PictureView view(mesh, q, composite, shifts);
    Canvas            canvas(view.width, view.height);
    double            mean_radius = 0;
    int               object      = 0;

    for (const Vector3 &shift : shifts)
      for (unsigned int f = 0; f < mesh.lines().size(); ++f)
        {
          auto sections = sample_sections(mesh, q, f, picture_intervals);
          for (Section &section : sections)
            section.center += shift;
          const SectionSkin skin(sections, picture_around);
          const Color       color =
            tow_color(fibers.tows[mesh.lines()[f].tow])
              .lighter(object < static_cast<int>(mesh.lines().size()) ?
                         0 :
                         neighbors_lighter);
          const Brush brush{canvas, view, color, object};
          draw_skin(brush, skin);
          draw_end(brush, skin, sections.front(), 0);
          draw_end(brush, skin, sections.back(), skin.n_rings - 1);
          ++object;
          mean_radius +=
            mesh.lines()[f].radius / (mesh.lines().size() * shifts.size());
        }
    if (composite != nullptr)
      draw_matrix(canvas, view, *composite, q, object);
    return canvas.png(3 * mean_radius * view.scale);
  }
} // namespace fiberloom
