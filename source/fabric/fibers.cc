// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/parameter_catalogue.h>
#include <fiberloom/base/parameters.h>

#include <fiberloom/fabric/arrangement.h>
#include <fiberloom/fabric/curve.h>
#include <fiberloom/fabric/fiber_checks.h>
#include <fiberloom/fabric/fiber_file.h>
#include <fiberloom/fabric/fiber_set.h>
#include <fiberloom/fabric/tow_groups.h>

#include <deal.II/base/utilities.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace fiberloom
{
  namespace
  {
    Vector3
    read_point(const std::string &text)
    {
      std::istringstream in(text);
      Vector3            point;
      in >> point[0] >> point[1] >> point[2];
      std::string more;
      if (in.fail() || in >> more)
        throw InputError("\"" + text +
                         "\" is no point; allowed: three numbers x y z with "
                         "blanks between");
      return point;
    }

    Polyline
    read_polyline(const std::string &text)
    {
      Polyline line;
      for (const std::string &point :
           dealii::Utilities::split_string_list(text, ','))
        line.push_back(read_point(point));
      return line;
    }

    /** The first ones of @p names . */
    std::string
    listed(const std::vector<std::string> &names)
    {
      constexpr std::size_t most = 20;
      std::string           list;
      for (std::size_t n = 0; n < std::min(names.size(), most); ++n)
        list += (n > 0 ? ", " : "") + names[n].substr(0, 50);
      return list + (names.size() > most ? ", ..." : "");
    }

    void
    check_points(const Polyline &line)
    {
      for (std::size_t i = 0; i < line.size(); ++i)
        check_place(line[i], "point " + std::to_string(i));
      if (line.size() < 2)
        throw InputError("it has " + std::to_string(line.size()) +
                         " points; allowed: two or more");
      for (std::size_t i = 1; i < line.size(); ++i)
        if ((line[i] - line[i - 1]).norm() <= 1e-12 * line[i].norm())
          throw InputError("points " + std::to_string(i - 1) + " and " +
                           std::to_string(i) +
                           " are the same; allowed: different points");
    }

    /** Across @p tangent , nearest to the axis it is least aligned with. */
    Vector3
    any_direction_across(const Vector3 &tangent)
    {
      Vector3::Index axis;
      tangent.cwiseAbs().minCoeff(&axis);
      const Vector3 direction = Vector3::Unit(axis);
      return (direction - direction.dot(tangent) * tangent).normalized();
    }

    /** With section vectors that do not twist along the line. */
    FiberPlacement
    place_along(const CenterLine &line)
    {
      const std::vector<Vector3> &tangent = line.tangents;
      Vector3        direction_1          = any_direction_across(tangent[0]);
      FiberPlacement placement;
      placement.centers = line.nodes;
      for (std::size_t n = 0; n < tangent.size(); ++n)
        {
          if (n > 0)
            direction_1 =
              Eigen::Quaterniond::FromTwoVectors(tangent[n - 1], tangent[n]) *
              direction_1;
          // rounding must not add up
          direction_1 -= direction_1.dot(tangent[n]) * tangent[n];
          direction_1.normalize();
          placement.directions_1.push_back(direction_1);
          placement.directions_2.push_back(tangent[n].cross(direction_1));
        }
      return placement;
    }

    /** Of the quadratic curve through three nodes, by two Gauss points. */
    double
    element_length(const Vector3 &start,
                   const Vector3 &middle,
                   const Vector3 &end)
    {
      const Vector3 chord = end - start, bend = start - 2 * middle + end;
      const double  xi = 1 / std::sqrt(3.);
      return .5 *
             ((chord + 2 * xi * bend).norm() + (chord - 2 * xi * bend).norm());
    }

    /** The same elements in a straight row from the same first section. */
    FiberPlacement
    straightened(const FiberPlacement &placement)
    {
      const auto   &x      = placement.centers;
      const Vector3 first  = placement.directions_1[0],
                    second = placement.directions_2[0];
      const Vector3  along = first.cross(second);
      FiberPlacement straight;
      straight.centers.push_back(x[0]);
      for (std::size_t n = 2; n < x.size(); n += 2)
        {
          const double  length = element_length(x[n - 2], x[n - 1], x[n]);
          const Vector3 start  = straight.centers.back();
          straight.centers.push_back(start + .5 * length * along);
          straight.centers.push_back(start + length * along);
        }
      straight.directions_1.assign(x.size(), first);
      straight.directions_2.assign(x.size(), second);
      return straight;
    }

    /** Adds the fibers of the source that is given to a set. */
    class FiberBuilder
    {
    public:
      explicit FiberBuilder(const Parameters &parameters)
        : parameters(parameters)
        , fibers(parameters.fibers)
        , source(parameters.where("Fibers/" + fibers.sources().front()) +
                 (fibers.file.empty() ? "" : ": " + fibers.file))
        , n_nodes(2 * fibers.elements_per_fiber + 1)
      {}

      FiberSet
      build()
      {
        if (!fibers.polylines.empty())
          add_polylines();
        else if (!fibers.file.empty())
          add_file();
        else if (!fibers.curves.empty())
          add_curves();
        else if (fibers.arrangement == Arrangement::bundle)
          add_bundle();
        else
          add_strand();
        explained(source, [&] { check_apart(set.fibers); });
        return set;
      }

    private:
      const Parameters       &parameters;
      const FibersParameters &fibers;
      const std::string       source; // of the fibers, for the user
      const unsigned int      n_nodes;
      FiberSet                set;

      /** Calls @p build , and says @p where it is when it fails. */
      template <class Build>
      static void
      explained(const std::string &where, const Build &build)
      {
        try
          {
            build();
          }
        catch (const InputError &error)
          {
            throw InputError(where + ": " + error.what());
          }
      }

      /** That of @p group out of @p n_groups . */
      double
      value_of(const std::vector<double> &values,
               const std::string         &entry,
               const unsigned int         group,
               const unsigned int         n_groups) const
      {
        if (values.size() != 1 && values.size() != n_groups)
          throw InputError(
            parameters.where("Fibers/" + entry) + ": " +
            std::to_string(values.size()) + " values; allowed: 1" +
            (n_groups > 1 ? " or " + std::to_string(n_groups) : ""));
        return values[values.size() == 1 ? 0 : group];
      }

      void
      check_size(const double n_fibers) const
      {
        if (n_fibers * n_nodes > Parameters::most_nodes)
          throw InputError(parameters.where("Fibers/Elements per fiber") +
                           ": the model would have more than " +
                           std::to_string(Parameters::most_nodes) +
                           " nodes; allowed: fewer elements or fibers");
      }

      /** A fiber without its nodes. */
      Fiber
      member_of(const unsigned int group, const unsigned int n_groups) const
      {
        Fiber fiber;
        fiber.radius = value_of(fibers.radius, "Radius", group, n_groups);
        fiber.young_modulus =
          value_of(fibers.young_modulus, "Young modulus", group, n_groups);
        fiber.poisson_ratio =
          value_of(fibers.poisson_ratio, "Poisson ratio", group, n_groups);
        fiber.density  = value_of(fibers.density, "Density", group, n_groups);
        fiber.law      = fibers.axial_law;
        fiber.strength = fibers.strength;
        return fiber;
      }

      void
      add(Fiber fiber, const CenterLine &line)
      {
        const unsigned int   number = set.fibers.size();
        const FiberPlacement given  = place_along(line);
        FiberPlacement       free   = given;
        if (fibers.stress_free == StressFree::straight)
          {
            free          = straightened(given);
            fiber.initial = given;
          }
        fiber.tow          = number;
        fiber.centers      = free.centers;
        fiber.directions_1 = free.directions_1;
        fiber.directions_2 = free.directions_2;
        check_proportions(fiber);
        check_bends(fiber);
        set.tows.push_back({Tow::Family::none,
                            number,
                            0.,
                            fiber.radius,
                            fiber.radius,
                            {number}});
        set.fibers.push_back(std::move(fiber));
      }

      /** @p joining of the points unless the user asks for another. */
      void
      add_through(const Fiber &fiber, const Polyline &points, Joining joining)
      {
        check_points(points);
        if (fibers.interpolation != Joining::automatic)
          joining = fibers.interpolation;
        add(fiber,
            joining == Joining::smooth && points.size() > 2 ?
              divide(smooth_curve(points), n_nodes) :
              divide(points, n_nodes));
      }

      void
      add_polylines()
      {
        const std::vector<std::string> lines =
          dealii::Utilities::split_string_list(fibers.polylines, ';');
        check_size(lines.size());
        for (unsigned int l = 0; l < lines.size(); ++l)
          {
            const Fiber fiber = member_of(l, lines.size());
            explained(source + ": line number " + std::to_string(l), [&] {
              add_through(fiber, read_polyline(lines[l]), Joining::straight);
            });
          }
      }

      void
      add_file()
      {
        FiberFile file;
        explained(source, [&] { file = read_fiber_file(fibers.file); });
        const std::vector<FiberPoints> &read = file.fibers;
        if (!file.ignored.empty())
          set.notes.push_back(source + ": ignored are " + listed(file.ignored) +
                              "; read are " + file.read);
        check_size(read.size());
        for (std::size_t f = 0; f < read.size(); ++f)
          {
            const auto &values  = read[f].values;
            Fiber       fiber   = member_of(0, 1);
            fiber.radius        = values[0].value_or(fiber.radius);
            fiber.young_modulus = values[1].value_or(fiber.young_modulus);
            fiber.poisson_ratio = values[2].value_or(fiber.poisson_ratio);
            explained(source + ": fiber " + std::to_string(f), [&] {
              add_through(fiber, read[f].points, Joining::smooth);
            });
          }
        if (read.front().tow)
          explained(source, [&] { group_into_tows(read, set); });
      }

      void
      add_curves()
      {
        const std::vector<std::string> curves =
          dealii::Utilities::split_string_list(fibers.curves, '|');
        const auto &numbers = fibers.fibers_per_curve;
        if (numbers.size() != 1 && numbers.size() != curves.size())
          throw InputError(parameters.where("Fibers/Fibers per curve") + ": " +
                           std::to_string(numbers.size()) +
                           " numbers; allowed: 1 or as many as curves, " +
                           std::to_string(curves.size()));
        for (unsigned int c = 0; c < curves.size(); ++c)
          {
            const Fiber        fiber = member_of(c, curves.size());
            const unsigned int n     = numbers[numbers.size() == 1 ? 0 : c];
            check_size(set.fibers.size() + n);
            for (unsigned int i = 0; i < n; ++i)
              explained(source + ": curve number " + std::to_string(c) +
                          ", i = " + std::to_string(i),
                        [&] { add(fiber, curve_line(curves[c], i)); });
          }
      }

      CenterLine
      curve_line(const std::string &functions, const unsigned int i) const
      {
        const std::size_t n =
          dealii::Utilities::split_string_list(functions, ';').size();
        if (n != 3)
          throw InputError(std::to_string(n) +
                           " functions; allowed: three functions of s and i "
                           "with semicolons between, such as s; 0; 0.1*i");
        return divide(parsed_curve(functions, i), n_nodes);
      }

      void
      add_bundle()
      {
        const BundleParameters            &bundle = fibers.bundle;
        const Fiber                        fiber  = member_of(0, 1);
        std::vector<std::array<double, 2>> centers;
        explained(parameters.where("Fibers/Bundle/Fibers"),
                  [&] { centers = hexagon(bundle.fibers); });
        check_size(centers.size());
        for (const auto &center : centers)
          {
            const double distance = bundle.spacing * fiber.radius;
            Vector3      end(.5 * bundle.length,
                        distance * center[0],
                        distance * center[1]);
            Vector3      start = end;
            start[0]           = -end[0];
            add(fiber, divide(Polyline{start, end}, n_nodes));
          }
      }

      void
      add_strand()
      {
        const StrandParameters &strand = fibers.strand;
        const Fiber             core = member_of(0, 2), outer = member_of(1, 2);
        const double            radius = core.radius + outer.radius;
        check_strand(core.radius, outer.radius);
        check_size(strand.outer_fibers + 1);

        const double turns =
          strand.lay_length != 0 ?
            strand.length / strand.lay_length :
            strand.length * std::tan(strand.lay_angle) / (2 * M_PI * radius);
        const Vector3 end = .5 * strand.length * Vector3::UnitX();
        add(core, divide(Polyline{-end, end}, n_nodes));
        for (unsigned int i = 0; i < strand.outer_fibers; ++i)
          explained(source + ": an outer fiber", [&] {
            add(outer,
                divide(helix(strand.length,
                             radius,
                             turns,
                             2 * M_PI * i / strand.outer_fibers),
                       n_nodes));
          });
      }

      void
      check_strand(const double core, const double outer) const
      {
        const StrandParameters &strand = fibers.strand;
        if ((strand.lay_angle != 0) == (strand.lay_length != 0))
          throw InputError(parameters.where("Fibers/Strand/Lay angle") + ": " +
                           (strand.lay_angle != 0 ?
                              "Lay length is given, too" :
                              "neither it nor Lay length is given") +
                           "; allowed: one of them other than 0");
        const unsigned int n             = strand.outer_fibers;
        const double       half_distance = (core + outer) * std::sin(M_PI / n);
        if (n > 1 && half_distance < outer * (1 - 1e-12))
          throw InputError(
            parameters.where("Fibers/Strand/Outer fibers") + ": " +
            std::to_string(n) +
            " do not fit around the core; allowed: at most " +
            std::to_string(static_cast<unsigned int>(
              M_PI / std::asin(outer / (core + outer)) * (1 + 1e-12))));
      }
    };
  } // namespace

  FiberSet
  build_fibers(const Parameters &parameters)
  {
    return FiberBuilder(parameters).build();
  }
} // namespace fiberloom
