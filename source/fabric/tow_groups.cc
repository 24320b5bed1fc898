// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>

#include <fiberloom/fabric/tow_family.h>
#include <fiberloom/fabric/tow_groups.h>

#include <algorithm>
#include <cmath>

namespace fiberloom
{
  namespace
  {
    // Between mean lines where tows cross, over the radius.
    constexpr double least_height = 1e-3;

    // Of a fiber's direction along its tow.
    constexpr double least_cosine = .7;

    const Polyline &
    placed(const Fiber &fiber)
    {
      return fiber.initial ? fiber.initial->centers : fiber.centers;
    }

    std::string
    name_of(const Tow &tow)
    {
      return family_name(tow.family) + " tow " + std::to_string(tow.number);
    }

    /** Through the means of the fibers' nodes. */
    Polyline
    mean_line(const FiberSet &set, const Tow &tow)
    {
      Polyline mean(placed(set.fibers[tow.fibers[0]]).size(), Vector3::Zero());
      for (const unsigned int fiber : tow.fibers)
        for (std::size_t n = 0; n < mean.size(); ++n)
          mean[n] += placed(set.fibers[fiber])[n] / tow.fibers.size();
      return mean;
    }

    /** Coordinate along which a tow of the family runs. */
    unsigned int
    axis_of(const Tow::Family family)
    {
      return family == Tow::Family::warp ? 0 : 1;
    }

    void
    check_direction(const FiberSet &set, const Tow &tow)
    {
      const unsigned int d = axis_of(tow.family);
      for (const unsigned int fiber : tow.fibers)
        {
          const Polyline &line  = placed(set.fibers[fiber]);
          const Vector3   chord = line.back() - line.front();
          if (!(chord[d] > least_cosine * chord.norm()))
            throw InputError("fiber " + std::to_string(fiber) + " of " +
                             name_of(tow) + " does not run along " +
                             (d == 0 ? "x" : "y") +
                             "; allowed: warp along x and fill along y, from "
                             "the smaller to the larger coordinate");
        }
    }

    /** Position across the tow, and how far fibers are from the mean line. */
    void
    measure(const FiberSet &set, Tow &tow)
    {
      const Polyline     mean   = mean_line(set, tow);
      const unsigned int across = 1 - axis_of(tow.family);
      tow.center                = mean[mean.size() / 2][across];
      tow.half_width = tow.half_thickness = 0;
      for (const unsigned int fiber : tow.fibers)
        {
          const double radius = set.fibers[fiber].radius;
          for (std::size_t n = 0; n < mean.size(); ++n)
            {
              const Vector3 away = placed(set.fibers[fiber])[n] - mean[n];
              tow.half_width =
                std::max(tow.half_width, std::abs(away[across]) + radius);
              tow.half_thickness =
                std::max(tow.half_thickness, std::abs(away[2]) + radius);
            }
        }
    }

    /** Where x of a line that runs along y is at @p y ; none beyond its ends.
     */
    std::optional<Vector3>
    point_at(const Polyline &fill, const double y)
    {
      const auto after =
        std::upper_bound(fill.begin(),
                         fill.end(),
                         y,
                         [](const double value, const Vector3 &point) {
                           return value < point[1];
                         });
      if (after == fill.begin() || after == fill.end())
        return {};
      const Vector3 &a = *(after - 1), &b = *after;
      return a + (y - a[1]) / (b[1] - a[1]) * (b - a);
    }

    /** Height of @p warp above @p fill where they cross in plan. */
    std::optional<double>
    height_of_crossing(const Polyline &warp, const Polyline &fill)
    {
      std::optional<double>  before;
      std::optional<Vector3> met_before;
      for (std::size_t n = 0; n < warp.size(); ++n)
        {
          const auto met = point_at(fill, warp[n][1]);
          if (!met)
            {
              before.reset();
              continue;
            }
          const double beside = warp[n][0] - (*met)[0];
          if (before && *before < 0 && beside >= 0)
            {
              const double part = *before / (*before - beside);
              return (1 - part) * (warp[n - 1][2] - (*met_before)[2]) +
                     part * (warp[n][2] - (*met)[2]);
            }
          before     = beside;
          met_before = met;
        }
      return {};
    }

    /** One row for each fill tow. */
    std::string
    rows_of(const FiberSet &set)
    {
      std::vector<Polyline>    lines;
      std::vector<const Tow *> families[2];
      for (const Tow &tow : set.tows)
        {
          lines.push_back(mean_line(set, tow));
          families[axis_of(tow.family)].push_back(&tow);
        }
      const auto line = [&](const Tow *tow) -> const Polyline & {
        return lines[tow - set.tows.data()];
      };
      std::string rows;
      for (const Tow *fill : families[1])
        {
          rows += rows.empty() ? "" : " ";
          for (const Tow *warp : families[0])
            {
              const auto height = height_of_crossing(line(warp), line(fill));
              const std::string names =
                name_of(*warp) + " and " + name_of(*fill);
              if (!height)
                throw InputError(names + " do not cross; allowed: tows that "
                                         "each cross all of the other family");
              if (std::abs(*height) <
                  least_height * set.fibers[warp->fibers[0]].radius)
                throw InputError(names + " cross at the same height; allowed: "
                                         "one above the other");
              rows += *height > 0 ? '1' : '0';
            }
        }
      return rows;
    }

    void
    check_order(const FiberSet &set)
    {
      for (std::size_t t = 1; t < set.tows.size(); ++t)
        {
          const Tow &before = set.tows[t - 1], &tow = set.tows[t];
          if (before.family == Tow::Family::fill &&
              tow.family == Tow::Family::warp)
            throw InputError("tow " + std::to_string(t) +
                             " is of the warp, behind one of the fill; "
                             "allowed: first all warp tows, then the fill");
          if (before.family == tow.family && !(tow.center > before.center))
            throw InputError(name_of(tow) + " is not behind the one before; "
                                            "allowed: warp tows from the "
                                            "smallest y on, fill tows from "
                                            "the smallest x on");
        }
    }
  } // namespace



  void
  group_into_tows(const std::vector<FiberPoints> &read, FiberSet &set)
  {
    set.tows.clear();
    std::size_t n_of_family[3] = {0, 0, 0};
    for (std::size_t f = 0; f < read.size(); ++f)
      {
        const Tow::Family family = *read[f].family;
        if (*read[f].tow == set.tows.size())
          set.tows.push_back(
            {family,
             static_cast<unsigned int>(n_of_family[static_cast<int>(family)]++),
             0.,
             0.,
             0.,
             {}});
        set.fibers[f].tow = *read[f].tow;
        set.tows.back().fibers.push_back(f);
        if (set.tows.back().family != family)
          throw InputError("tow " + std::to_string(*read[f].tow) +
                           " has fibers of two families; allowed: one");
      }

    const auto n_loose = n_of_family[static_cast<int>(Tow::Family::none)];
    for (Tow &tow : set.tows)
      measure(set, tow);
    if (n_loose == set.tows.size())
      return;
    const auto n_warp = n_of_family[static_cast<int>(Tow::Family::warp)];
    if (n_loose > 0 || n_warp == 0 || n_warp == set.tows.size())
      throw InputError("there are " + std::to_string(n_warp) +
                       " warp tows and " +
                       std::to_string(set.tows.size() - n_warp - n_loose) +
                       " fill tows among " + std::to_string(set.tows.size()) +
                       "; allowed: warp and fill, or none");
    for (const Tow &tow : set.tows)
      check_direction(set, tow);
    check_order(set);
    set.pattern = WeavePattern(rows_of(set), n_warp, set.tows.size() - n_warp);
  }
} // namespace fiberloom
