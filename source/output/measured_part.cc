// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/output/fiber_samples.h>
#include <fiberloom/output/measured_part.h>

#include <algorithm>
#include <cmath>

namespace fiberloom
{
  namespace
  {
    // Area of the whole over the sum of its pieces, below which a fabric is not
    // flat: one that is bent by some 40 degrees.
    constexpr double least_flatness = .98;

    constexpr unsigned int most_iterations = 30;

    /** Of the mean line of a tow's fibers. */
    struct LinePoint
    {
      Vector3 position;   // [mm]
      Vector3 derivative; // by the fraction of the length
    };

    /** Where two mean lines are closest: fractions, and the middle between. */
    struct Crossing
    {
      std::array<double, 2> fractions; // of warp and fill
      Vector3               middle;
    };

    using Crossings = std::vector<std::vector<Crossing>>; // by warp and fill

    class CrossingFinder
    {
    public:
      CrossingFinder(const FiberSet  &fibers,
                     const FiberMesh &mesh,
                     const DofVector &q)
        : mesh(mesh)
        , q(q)
      {
        for (const Tow &tow : fibers.tows)
          if (tow.family != Tow::Family::none)
            family(tow).push_back(&tow);
      }

      /** None where lines do not cross one after the other. */
      std::optional<Crossings>
      find() const
      {
        const std::size_t n_warp = tows[0].size(), n_fill = tows[1].size();
        if (n_warp < 2 || n_fill < 2)
          return {};
        Crossings found(n_warp);
        for (std::size_t w = 0; w < n_warp; ++w)
          for (std::size_t f = 0; f < n_fill; ++f)
            {
              const auto crossing =
                find(*tows[0][w],
                     *tows[1][f],
                     {{(f + .5) / n_fill, (w + .5) / n_warp}});
              if (!crossing)
                return {};
              found[w].push_back(*crossing);
              if ((f > 0 &&
                   crossing->fractions[0] <= found[w][f - 1].fractions[0]) ||
                  (w > 0 &&
                   crossing->fractions[1] <= found[w - 1][f].fractions[1]))
                return {};
            }
        return found;
      }

      LinePoint
      point(const Tow &tow, const double fraction) const
      {
        LinePoint    mean{Vector3::Zero(), Vector3::Zero()};
        const double part = 1. / tow.fibers.size();
        for (const unsigned int fiber : tow.fibers)
          {
            const double n = mesh.lines()[fiber].n_elements;
            const auto   section =
              mesh.section(q, mesh.locate(fiber, fraction * n));
            mean.position += part * section.center;
            mean.derivative += part * n * section.center_derivative;
          }
        return mean;
      }

    private:
      const FiberMesh                        &mesh;
      const DofVector                        &q;
      std::array<std::vector<const Tow *>, 2> tows; // warp and fill

      std::vector<const Tow *> &
      family(const Tow &tow)
      {
        return tows[tow.family == Tow::Family::warp ? 0 : 1];
      }

      /** By the method of Gauss and Newton. */
      std::optional<Crossing>
      find(const Tow &warp, const Tow &fill, std::array<double, 2> x) const
      {
        for (unsigned int i = 0; i < most_iterations; ++i)
          {
            const LinePoint a = point(warp, x[0]), b = point(fill, x[1]);
            Eigen::Matrix<double, 3, 2> slopes;
            slopes << a.derivative, -b.derivative;
            const Eigen::Vector2d step =
              -(slopes.transpose() * slopes)
                 .ldlt()
                 .solve(slopes.transpose() * (a.position - b.position));
            for (unsigned int s = 0; s < 2; ++s)
              x[s] = std::clamp(x[s] + step[s], 0., 1.);
            if (step.norm() < 1e-9)
              return Crossing{x, .5 * (a.position + b.position)};
          }
        return {};
      }
    };

    /** Area and normal of the cells between crossings; false unless flat. */
    bool
    measure_cells(const Crossings &crossings, MeasuredPart &part)
    {
      Vector3 sum = Vector3::Zero();
      part.area   = 0;
      for (std::size_t w = 1; w < crossings.size(); ++w)
        for (std::size_t f = 1; f < crossings[w].size(); ++f)
          {
            const auto corner = [&](const int dw, const int df) {
              return crossings[w + dw][f + df].middle;
            };
            const Vector3 cell = .5 * (corner(0, 0) - corner(-1, -1))
                                        .cross(corner(0, -1) - corner(-1, 0));
            sum += cell;
            part.area += cell.norm();
          }
      if (!(sum.norm() > least_flatness * part.area))
        return false;
      part.area   = sum.norm();
      part.normal = (sum[2] < 0 ? -1 : 1) * sum.normalized();
      return true;
    }

    /** A periodic cell is measured as a whole. */
    MeasuredPart
    whole_cell(const FiberSet       &fibers,
               const FiberMesh      &mesh,
               const CrossingFinder &finder)
    {
      MeasuredPart           part;
      std::array<Vector3, 2> periods = {{Vector3::Zero(), Vector3::Zero()}};
      for (const Tow &tow : fibers.tows)
        {
          const Vector3 period =
            finder.point(tow, 1).position - finder.point(tow, 0).position;
          periods[tow.family == Tow::Family::warp ? 0 : 1] = period;
          part.tows.push_back({{{0, 1}}, period.norm(), 1});
        }
      const Vector3 area = periods[0].cross(periods[1]);
      part.area          = area.norm();
      part.normal        = area.normalized();
      for (const FiberMesh::Line &line : mesh.lines())
        part.fibers.push_back({{0, double(line.n_elements)}});
      return part;
    }
  } // namespace



  std::optional<MeasuredPart>
  part_between_crossings(const FiberSet  &fibers,
                         const FiberMesh &mesh,
                         const DofVector &q)
  {
    const CrossingFinder finder(fibers, mesh, q);
    if (fibers.cell)
      return whole_cell(fibers, mesh, finder);
    const auto   crossings = finder.find();
    MeasuredPart part;
    if (!crossings || !measure_cells(*crossings, part))
      return {};

    part.fibers.resize(fibers.fibers.size());
    for (const Tow &tow : fibers.tows)
      {
        const bool         is_warp = tow.family == Tow::Family::warp;
        const auto        &first = is_warp ? (*crossings)[tow.number].front() :
                                             crossings->front()[tow.number];
        const auto        &last  = is_warp ? (*crossings)[tow.number].back() :
                                             crossings->back()[tow.number];
        const unsigned int side  = is_warp ? 0 : 1;
        const std::size_t  n_tows =
          is_warp ? crossings->size() : crossings->front().size();

        MeasuredPart::TowPart measured;
        measured.fractions = {{first.fractions[side], last.fractions[side]}};
        measured.share = tow.number == 0 || tow.number + 1 == n_tows ? .5 : 1;
        const std::array<Vector3, 2> ends = {
          {finder.point(tow, measured.fractions[0]).position,
           finder.point(tow, measured.fractions[1]).position}};
        Vector3 along = ends[1] - ends[0];
        along -= along.dot(part.normal) * part.normal;
        measured.length = along.norm();
        part.tows.push_back(measured);
        for (const unsigned int fiber : tow.fibers)
          for (unsigned int e = 0; e < 2; ++e)
            part.fibers[fiber][e] =
              parameter_on_plane(mesh,
                                 q,
                                 fiber,
                                 measured.fractions[e] *
                                   mesh.lines()[fiber].n_elements,
                                 {along / measured.length, ends[e]});
      }
    return part;
  }
} // namespace fiberloom
