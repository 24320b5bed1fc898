// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/output/texgen.h>
#include <fiberloom/output/tow_sections.h>

#include <deal.II/base/numbers.h>

#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace fiberloom
{
  namespace
  {
    constexpr unsigned int corners = 40, points_per_fiber = 48;

    void
    write_vector(std::ostream &out, const std::string &name, const Vector3 &v)
    {
      out << " " << name << "=\"" << v[0] << ", " << v[1] << ", " << v[2]
          << "\"";
    }

    /** Distance from the center to the border in direction @p angle . */
    double
    reach(const std::vector<TowCut::Point> &hull, const double angle)
    {
      const double x = std::cos(angle), y = std::sin(angle);
      double       least = std::numeric_limits<double>::max();
      for (std::size_t c = 0; c < hull.size(); ++c)
        {
          const auto  &a = hull[c], &b = hull[(c + 1) % hull.size()];
          const double normal_x = b[1] - a[1], normal_y = a[0] - b[0];
          const double slope = normal_x * x + normal_y * y;
          if (slope > 0)
            least =
              std::min(least, (normal_x * a[0] + normal_y * a[1]) / slope);
        }
      return least;
    }

    /** Its first axis is tangent times up, the other way round than ours. */
    void
    write_section(std::ostream      &out,
                  const TowCut      &cut,
                  const unsigned int number)
    {
      const auto hull = cut.hull(points_per_fiber);
      out << "        <NodeSection nodeindex=\"" << number
          << "\">\n          <Section type=\"CSectionPolygon\" "
             "EquiSpaced=\"0\">\n";
      for (unsigned int c = 0; c < corners; ++c)
        {
          const double angle = 2 * dealii::numbers::PI * c / corners;
          const double r     = reach(hull, dealii::numbers::PI - angle);
          out << "            <PolygonPoint value=\"" << r * std::cos(angle)
              << ", " << r * std::sin(angle) << "\" />\n";
        }
      out << "          </Section>\n        </NodeSection>\n";
    }

    void
    write_yarn(std::ostream              &out,
               const unsigned int         number,
               const std::vector<TowCut> &cuts)
    {
      out << "    <Yarn index=\"" << number << "\" NumSlaveNodes=\""
          << 2 * cuts.size() << "\" NumSectionPoints=\"" << corners
          << "\" NeedsBuilding=\"7\">\n"
          << "      <Interpolation Periodic=\"0\" ForceInPlaneTangent=\"0\" "
             "ForceMasterNodeTangent=\"0\" type=\"CInterpolationBezier\" />\n"
          << "      <YarnSection type=\"CYarnSectionInterpNode\" "
             "ConstMesh=\"1\" Ramped=\"0\" Polar=\"0\">\n";
      for (std::size_t i = 0; i < cuts.size(); ++i)
        write_section(out, cuts[i], i);
      out << "      </YarnSection>\n"
          << "      <FibreDistribution type=\"CFibreDistributionConst\" />\n";
      for (std::size_t i = 0; i < cuts.size(); ++i)
        {
          out << "      <MasterNode index=\"" << i << "\"";
          write_vector(out, "Position", cuts[i].center);
          write_vector(out, "Tangent", cuts[i].tangent);
          write_vector(out, "Up", cuts[i].up);
          out << " Angle=\"0\" />\n";
        }
      out << "    </Yarn>\n";
    }
  } // namespace



  std::string
  texgen_xml(const FiberSet &fibers, const FiberMesh &mesh, const DofVector &q)
  {
    std::ostringstream out;
    out << std::setprecision(9) << "<?xml version=\"1.0\" ?>\n"
        << "<TexGenModel version=\"3.9.0\">\n"
        << "  <Textile name=\"fiberloom\" type=\"CTextile\" "
           "NeedsBuilding=\"0\">\n";
    for (unsigned int t = 0; t < fibers.tows.size(); ++t)
      {
        const Tow          &tow = fibers.tows[t];
        const unsigned int  n = 2 * mesh.lines()[tow.fibers.front()].n_elements;
        std::vector<TowCut> cuts;
        for (unsigned int i = 0; i <= n; ++i)
          cuts.push_back(cut_tow(tow, mesh, q, double(i) / n));
        write_yarn(out, t, cuts);
      }
    out << "  </Textile>\n</TexGenModel>\n";
    return out.str();
  }
} // namespace fiberloom
