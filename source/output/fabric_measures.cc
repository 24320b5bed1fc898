// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/fabric/fiber_density.h>
#include <fiberloom/fabric/tow_family.h>

#include <fiberloom/output/fabric_measures.h>
#include <fiberloom/output/fiber_samples.h>
#include <fiberloom/output/tow_sections.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>

namespace fiberloom
{
  namespace
  {
    constexpr double kg_per_m2 = 1e9; // in t/mm^2

    /** Over the parameter u, by three Gauss points in each element. */
    double
    integrate(const FiberMesh                              &mesh,
              const DofVector                              &q,
              const unsigned int                            fiber,
              const std::array<double, 2>                  &range,
              const std::function<double(const Section &)> &f)
    {
      const double x   = std::sqrt(.6);
      double       sum = 0;
      for (double from = range[0]; from < range[1];)
        {
          const double to = std::min(std::floor(from) + 1, range[1]);
          for (const auto &[xi, weight] :
               {std::pair{-x, 5 / 18.}, {0., 8 / 18.}, {x, 5 / 18.}})
            sum +=
              (to - from) * weight *
              f(mesh.section(
                q, mesh.locate(fiber, .5 * (from + to + xi * (to - from)))));
          from = to;
        }
      return sum;
    }

    double
    length(const FiberMesh             &mesh,
           const DofVector             &q,
           const unsigned int           fiber,
           const std::array<double, 2> &range)
    {
      return integrate(mesh, q, fiber, range, [](const Section &section) {
        return section.center_derivative.norm();
      });
    }

    /** A mean over tows, each with its weight, and the standard deviation. */
    class Mean
    {
    public:
      void
      add(const double value, const double weight)
      {
        weights += weight;
        sum += weight * value;
        squares += weight * value * value;
      }

      double
      value() const
      {
        return sum / weights;
      }

      double
      spread() const
      {
        const double variance = squares / weights - value() * value();
        return std::sqrt(std::max(0., variance));
      }

    private:
      double weights = 0, sum = 0, squares = 0;
    };

    /** Of the tows of one family. */
    struct FamilyMeasures
    {
      Mean   crimp, width, height, area, packing, undulation;
      double curvature = 0, bending_strain = 0;
    };

    class Measurement
    {
    public:
      Measurement(const FiberSet     &fibers,
                  const FiberMesh    &mesh,
                  const DofVector    &q,
                  const MeasuredPart &part)
        : fibers(fibers)
        , mesh(mesh)
        , q(q)
        , part(part)
      {
        for (unsigned int t = 0; t < fibers.tows.size(); ++t)
          {
            measure_tow(t);
            for (const unsigned int fiber : fibers.tows[t].fibers)
              measure_fiber(fiber, part.tows[t].share);
          }
      }

      Measures
      result() const
      {
        const double thickness = high - low;
        Measures     all       = {{{"thickness", Quantity::length}, thickness},
                                  {{"areal_weight", Quantity::areal_weight},
                                   kg_per_m2 * mass / part.area},
                                  {{"fiber_volume_fraction", Quantity::fraction},
                                   volume / (part.area * thickness)},
                                  {{"fiber_volume_fraction_of_tows", Quantity::fraction},
                                   in_tows.value()},
                                  {{"measured_area", Quantity::area}, part.area}};
        const auto   add       = [&](const std::string &name,
                             const Quantity     quantity,
                             const auto        &value) {
          for (const auto family : {Tow::Family::warp, Tow::Family::fill})
            all.push_back({{name + "_" + family_name(family),
                            quantity,
                            Role::detail,
                            family},
                           value(families[index(family)])});
        };
        using Family = FamilyMeasures;
        add("crimp", Quantity::strain, [](const Family &f) {
          return f.crimp.value();
        });
        add("crimp_spread", Quantity::strain, [](const Family &f) {
          return f.crimp.spread();
        });
        add("tow_width", Quantity::length, [](const Family &f) {
          return f.width.value();
        });
        add("tow_height", Quantity::length, [](const Family &f) {
          return f.height.value();
        });
        add("tow_area", Quantity::area, [](const Family &f) {
          return f.area.value();
        });
        add("tow_packing", Quantity::fraction, [](const Family &f) {
          return f.packing.value();
        });
        add("undulation_angle", Quantity::angle, [](const Family &f) {
          return f.undulation.value();
        });
        add("largest_curvature", Quantity::curvature, [](const Family &f) {
          return f.curvature;
        });
        add("largest_bending_strain", Quantity::strain, [](const Family &f) {
          return f.bending_strain;
        });
        all.erase(std::remove_if(all.begin(),
                                 all.end(),
                                 [](const auto &measure) {
                                   return !std::isfinite(measure.second);
                                 }),
                  all.end());
        return all;
      }

    private:
      const FiberSet     &fibers;
      const FiberMesh    &mesh;
      const DofVector    &q;
      const MeasuredPart &part;

      double low = std::numeric_limits<double>::max(), high = -low;
      double mass = 0, volume = 0; // [t], [mm^3]
      Mean   in_tows;
      std::array<FamilyMeasures, 2> families; // warp and fill

      static unsigned int
      index(const Tow::Family family)
      {
        return family == Tow::Family::warp ? 0 : 1;
      }

      FamilyMeasures &
      family(const unsigned int tow)
      {
        return families[index(fibers.tows[tow].family)];
      }

      /** Sections at the nodes that are inside, and lengths of fibers. */
      void
      measure_tow(const unsigned int t)
      {
        const auto      sections = tow_sections(fibers, mesh, q, t);
        const auto     &inside   = part.tows[t];
        const double    share    = inside.share;
        FamilyMeasures &measures = family(t);
        for (std::size_t i = 0; i < sections.size(); ++i)
          {
            const double fraction = double(i) / (sections.size() - 1);
            if (fraction < inside.fractions[0] ||
                fraction > inside.fractions[1])
              continue;
            const TowSection &section = sections[i];
            measures.width.add(section.width, share);
            measures.height.add(section.height, share);
            measures.area.add(section.area, share);
            measures.packing.add(section.packing, share);
            in_tows.add(section.packing, share * section.area);
          }

        double mean_length = 0;
        for (const unsigned int fiber : fibers.tows[t].fibers)
          mean_length += length(mesh, q, fiber, part.fibers[fiber]) /
                         fibers.tows[t].fibers.size();
        measures.crimp.add(mean_length / inside.length - 1, share);
      }

      /** Samples at the nodes inside and at the borders of the part. */
      void
      measure_fiber(const unsigned int fiber, const double share)
      {
        const auto &range = part.fibers[fiber];
        const auto  none  = std::numeric_limits<double>::quiet_NaN();
        volume += share * fiber_volume(mesh, q, fiber, range);
        mass += share * known_density(fibers.fibers[fiber]).value_or(none) *
                fiber_volume(mesh, mesh.reference(), fiber, range);

        FamilyMeasures &measures   = family(fibers.fibers[fiber].tow);
        double          undulation = 0;
        for (const double u : range)
          include(mesh.section(q, mesh.locate(fiber, u)), undulation);
        for (const FiberSample &sample : sample_fiber(mesh, q, fiber, 4))
          if (sample.u > range[0] && sample.u < range[1])
            {
              include(sample.section, undulation);
              measures.curvature =
                std::max(measures.curvature, sample.curvature);
              measures.bending_strain =
                std::max(measures.bending_strain,
                         sample.curvature * mesh.lines()[fiber].radius);
            }
        measures.undulation.add(undulation, share);
      }

      /** In the thickness and in the largest angle to the fabric's plane. */
      void
      include(const Section &section, double &undulation)
      {
        const double height = section.center.dot(part.normal),
                     reach  = std::hypot(section.vector_1.dot(part.normal),
                                        section.vector_2.dot(part.normal));
        low                 = std::min(low, height - reach);
        high                = std::max(high, height + reach);
        const double sine =
          section.center_derivative.normalized().dot(part.normal);
        undulation = std::max(undulation, std::asin(std::abs(sine)));
      }
    };
  } // namespace



  Measures
  fabric_measures(const FiberSet     &fibers,
                  const FiberMesh    &mesh,
                  const DofVector    &q,
                  const MeasuredPart &part)
  {
    return Measurement(fibers, mesh, q, part).result();
  }



  double
  fiber_volume(const FiberMesh             &mesh,
               const DofVector             &q,
               const unsigned int           fiber,
               const std::array<double, 2> &range)
  {
    return dealii::numbers::PI *
           integrate(mesh, q, fiber, range, [](const Section &section) {
             return section.vector_1.cross(section.vector_2)
               .dot(section.center_derivative);
           });
  }



  FabricTable::FabricTable()
    : IncrementTable("fabric.csv")
  {}



  void
  FabricTable::append(const Place &place, const Measures &measures)
  {
    Cells cells;
    for (const auto &[column, value] : measures)
      cells.emplace_back(column.heading(), table_cell(value));
    IncrementTable::append(place, "", cells);
  }



  std::vector<std::pair<std::string, double>>
  FabricTable::last() const
  {
    std::vector<std::pair<std::string, double>> measures;
    if (!rows().empty())
      for (std::size_t c = 0; c < rows().back().cells.size(); ++c)
        if (const std::string &cell = rows().back().cells[c]; !cell.empty())
          measures.emplace_back(columns()[c],
                                std::strtod(cell.c_str(), nullptr));
    return measures;
  }
} // namespace fiberloom
