// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/output/fiber_samples.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace fiberloom
{
  namespace
  {
    /** Axial force, moment and curvature vector at a point. */
    using BeamValues = Eigen::Matrix<double, 7, 1>;

    ElementPoint
    sample_point(const FiberMesh::Line &line,
                 const unsigned int     sample,
                 const unsigned int     n_intervals)
    {
      const unsigned int element =
        std::min(sample / n_intervals, line.n_elements - 1);
      return {line.first_element + element,
              2. * (sample - element * n_intervals) / n_intervals - 1};
    }

    /** Turn of the section's normal per length of the deformed centre line. */
    Vector3
    curvature_vector(const BeamElement::Vector &q, const double xi)
    {
      const auto shape      = shape_values(xi);
      const auto derivative = shape_derivatives(xi);

      std::array<Vector3, 3> value, slope;
      for (unsigned int k = 0; k < 3; ++k)
        {
          value[k].setZero();
          slope[k].setZero();
          for (unsigned int n = 0; n < 3; ++n)
            {
              value[k] += shape[n] * q.segment<3>(9 * n + 3 * k);
              slope[k] += derivative[n] * q.segment<3>(9 * n + 3 * k);
            }
        }
      const Vector3 normal = value[1].cross(value[2]);
      const Vector3 change =
        slope[1].cross(value[2]) + value[1].cross(slope[2]);
      return normal.cross(change) / (normal.squaredNorm() * slope[0].norm());
    }

    BeamValues
    gauss_values(const FiberMesh    &mesh,
                 const DofVector    &q,
                 const FiberHistory &history,
                 const ElementPoint &point)
    {
      const auto dofs    = mesh.element_dofs(q, point.element);
      const auto section = mesh.section(q, point);
      const auto forces =
        mesh.visit_element(point.element,
                           history,
                           [&](const BeamElement &element) {
                             return element.section_forces(dofs, point.xi > 0);
                           });

      BeamValues values;
      values << forces.force.dot(section.tangent()), forces.moment,
        curvature_vector(dofs, point.xi);
      return values;
    }

    /** At the samples of one element, its two ends included. */
    std::vector<BeamValues>
    element_values(const FiberMesh    &mesh,
                   const DofVector    &q,
                   const FiberHistory &history,
                   const unsigned int  element,
                   const unsigned int  n_intervals)
    {
      const double     xi     = 1 / std::sqrt(3.);
      const BeamValues first  = gauss_values(mesh, q, history, {element, -xi});
      const BeamValues second = gauss_values(mesh, q, history, {element, xi});

      std::vector<BeamValues> values;
      for (unsigned int i = 0; i <= n_intervals; ++i)
        {
          const double xi = 2. * i / n_intervals - 1;
          values.push_back(.5 * (first + second) +
                           .5 * std::sqrt(3.) * xi * (second - first));
        }
      return values;
    }

    std::vector<BeamValues>
    fiber_values(const FiberMesh    &mesh,
                 const DofVector    &q,
                 const FiberHistory &history,
                 const unsigned int  fiber,
                 const unsigned int  n_intervals)
    {
      const auto             &line = mesh.lines()[fiber];
      std::vector<BeamValues> values(line.n_elements * n_intervals + 1,
                                     BeamValues::Zero());
      for (unsigned int e = 0; e < line.n_elements; ++e)
        {
          const auto part = element_values(
            mesh, q, history, line.first_element + e, n_intervals);
          for (unsigned int i = 0; i <= n_intervals; ++i)
            values[e * n_intervals + i] += part[i];
        }
      for (unsigned int e = 1; e < line.n_elements; ++e)
        values[e * n_intervals] *= .5;
      return values;
    }
  } // namespace



  std::vector<FiberSample>
  sample_fiber(const FiberMesh    &mesh,
               const DofVector    &q,
               const unsigned int  fiber,
               const unsigned int  n_intervals,
               const FiberHistory &history)
  {
    const auto &line     = mesh.lines()[fiber];
    const auto  sections = sample_sections(mesh, q, fiber, n_intervals);
    const auto  values   = fiber_values(mesh, q, history, fiber, n_intervals);

    std::vector<FiberSample> samples;
    for (unsigned int i = 0; i < sections.size(); ++i)
      {
        const auto    point   = sample_point(line, i, n_intervals);
        const auto    origin  = mesh.section(mesh.initial(), point);
        const Vector3 tangent = sections[i].tangent();
        const Vector3 moment  = values[i].segment<3>(1);
        const double  torque  = moment.dot(tangent);
        samples.push_back({mesh.parameter(point),
                           sections[i],
                           sections[i].center - origin.center,
                           values[i][0],
                           moment - torque * tangent,
                           torque,
                           values[i].tail<3>().norm()});
      }
    return samples;
  }



  std::vector<Section>
  sample_sections(const FiberMesh   &mesh,
                  const DofVector   &q,
                  const unsigned int fiber,
                  const unsigned int n_intervals)
  {
    const auto          &line = mesh.lines()[fiber];
    std::vector<Section> sections;
    for (unsigned int i = 0; i <= line.n_elements * n_intervals; ++i)
      sections.push_back(mesh.section(q, sample_point(line, i, n_intervals)));
    return sections;
  }



  double
  parameter_on_plane(const FiberMesh                    &mesh,
                     const DofVector                    &q,
                     const unsigned int                  fiber,
                     const double                        start,
                     const Eigen::Hyperplane<double, 3> &plane)
  {
    const double n = mesh.lines()[fiber].n_elements;
    double       u = start;
    for (unsigned int i = 0; i < 8; ++i)
      {
        const auto   section = mesh.section(q, mesh.locate(fiber, u));
        const double slope   = section.center_derivative.dot(plane.normal());
        if (slope <= 0)
          break;
        const double step = -plane.signedDistance(section.center) / slope;
        u                 = std::clamp(u + step, 0., n);
        if (std::abs(step) < 1e-10)
          break;
      }
    return u;
  }
} // namespace fiberloom
