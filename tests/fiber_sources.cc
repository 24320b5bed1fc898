// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// Fibers that are no fabric lie where their source says: curves, smooth lines
// through points, files of each kind, bundles and strands, with the values of
// their group.

#include <fiberloom/base/parameters.h>

#include <fiberloom/fabric/fabric_parameters.h>
#include <fiberloom/fabric/fiber_set.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>

#include "checks.h"

using namespace fiberloom;

namespace
{
  FiberSet
  build(const std::string &fibers)
  {
    std::ofstream("scene.prm") << "set Stages = load\nset Drives = d\n"
                                  "subsection Drive d\nset Ends = 0 start\n"
                                  "end\nsubsection Fibers\n"
                               << fibers << "\nend\n";
    Parameters parameters = Parameters::parse("scene.prm", {});
    resolve_fabric(parameters);
    return build_fiber_set(parameters);
  }

  Vector3
  tangent(const Fiber &fiber, const unsigned int node)
  {
    return fiber.directions_1[node].cross(fiber.directions_2[node]);
  }

  /** Largest distance of the nodes from those of @p expected , and of values.
   */
  double
  difference(const FiberSet &set, const FiberSet &expected)
  {
    if (set.fibers.size() != expected.fibers.size())
      return 1e300;
    double largest = 0;
    for (std::size_t f = 0; f < set.fibers.size(); ++f)
      {
        const Fiber &a = set.fibers[f], &b = expected.fibers[f];
        largest = std::max({largest,
                            std::abs(a.radius - b.radius),
                            std::abs(a.young_modulus / b.young_modulus - 1),
                            std::abs(a.poisson_ratio - b.poisson_ratio)});
        for (std::size_t n = 0; n < a.centers.size(); ++n)
          largest = std::max(largest, (a.centers[n] - b.centers[n]).norm());
      }
    return largest;
  }

  /** Ratio of the longest to the shortest distance of neighboring nodes. */
  double
  unevenness(const Fiber &fiber)
  {
    double least = 1e300, most = 0;
    for (std::size_t n = 1; n < fiber.centers.size(); ++n)
      {
        const double step = (fiber.centers[n] - fiber.centers[n - 1]).norm();
        least             = std::min(least, step);
        most              = std::max(most, step);
      }
    return most / least - 1;
  }

  void
  check_curves(Checks &checks)
  {
    // the parameter runs unevenly, the nodes must not
    const FiberSet arc = build(
      "set Curves = 100*sin(pi/8*(s+s^2)); 100 - 100*cos(pi/8*(s+s^2)); 0\n"
      "set Radius = 0.5");
    const Fiber &bend   = arc.fibers[0];
    double       beside = 0, oblique = 0;
    for (unsigned int n = 0; n < bend.centers.size(); ++n)
      {
        const Vector3 arm = bend.centers[n] - Vector3(0, 100, 0);
        beside            = std::max(beside, std::abs(arm.norm() / 100 - 1));
        oblique =
          std::max(oblique, std::abs(tangent(bend, n).dot(arm.normalized())));
      }
    checks.below("arc: nodes beside the circle", beside, 1e-12);
    checks.below("arc: tangents oblique to it", oblique, 1e-9);
    checks.below("arc: uneven nodes", unevenness(bend), 1e-6);
    checks.below("arc: end",
                 (bend.centers.back() -
                  Vector3(50 * std::sqrt(2.), 100 - 50 * std::sqrt(2.), 0))
                   .norm(),
                 1e-9);

    const FiberSet weave = build(
      "set Curves = 0.8*s - 0.4; 0.2*i - 0.3; 0.01*cos(pi*i)*sin(pi*(4*s-2))"
      " | 0.2*i - 0.3; 0.8*s - 0.4; -0.01*cos(pi*i)*sin(pi*(4*s-2))\n"
      "set Fibers per curve = 4, 3\nset Radius = 0.01, 0.009\n"
      "set Elements per fiber = 32");
    checks.equal("weave: fibers", weave.fibers.size(), 7);
    checks.equal("weave: radius of the last", weave.fibers[6].radius, .009);
    double beyond = 0;
    for (unsigned int f = 0; f < 4; ++f)
      for (const Vector3 &x : weave.fibers[f].centers)
        beyond = std::max({beyond,
                           std::abs(x[1] - (.2 * f - .3)),
                           std::abs(x[2] - (f % 2 == 0 ? .01 : -.01) *
                                             std::sin(M_PI * x[0] / .2))});
    checks.below("weave: nodes beside the sine", beyond, 1e-12);
  }

  std::string
  helix_points(const unsigned int n, const std::string &separator)
  {
    std::ostringstream text;
    text << std::setprecision(17);
    for (unsigned int k = 0; k <= n; ++k)
      {
        const double angle = 4 * M_PI * k / n;
        text << (k > 0 ? separator : "") << std::cos(angle) << ' '
             << std::sin(angle) << ' ' << .3 * angle;
      }
    return text.str();
  }

  double
  largest_departure_from_helix(const Fiber &fiber)
  {
    double largest = 0;
    for (unsigned int n = 0; n < fiber.centers.size(); ++n)
      {
        const Vector3 x     = fiber.centers[n];
        const double  angle = x[2] / .3;
        const Vector3 along(-std::sin(angle), std::cos(angle), .3);
        largest = std::max(
          {largest,
           (x - Vector3(std::cos(angle), std::sin(angle), x[2])).norm(),
           (tangent(fiber, n) - along.normalized()).norm()});
      }
    return largest;
  }

  void
  check_smooth_lines(Checks &checks)
  {
    const std::string rest   = "\nset Elements per fiber = 40\n"
                               "set Interpolation = smooth\nset Polylines = ";
    const double      coarse = largest_departure_from_helix(
      build(rest + helix_points(60, ", ")).fibers[0]);
    const double fine = largest_departure_from_helix(
      build(rest + helix_points(120, ", ")).fibers[0]);
    checks.below("smooth: departure from a helix of 60 points a turn",
                 fine,
                 1e-4);
    checks.above("smooth: order", std::log2(coarse / fine), 2.7);
    const Fiber parabola = build(rest + "-1 1 0, 0 0 0, 1 1 0").fibers[0];
    double      beside   = 0;
    for (const Vector3 &x : parabola.centers)
      beside = std::max(beside, std::abs(x[1] - x[0] * x[0]));
    checks.below("smooth: three points make a parabola", beside, 1e-12);
  }

  /** The rows of a helix and a line as a table, as .vtp and as .vtu. */
  void
  write_files()
  {
    constexpr unsigned int n = 60;
    std::istringstream     points(helix_points(n, "\n"));
    std::filesystem::create_directory("lines");
    std::ofstream table("lines/two.csv");
    table << "# a comment\n\nfiber, x[mm], y[mm], z[mm], radius[mm], "
             "young_modulus\n";
    std::ostringstream coordinates, connectivity;
    unsigned int       number = 0;
    for (std::string x, y, z; points >> x >> y >> z;)
      {
        table << "0, " << x << ", " << y << ", " << z << ", 0.03, 100\n";
        coordinates << x << ' ' << y << ' ' << z << '\n';
        connectivity << number++ << ' ';
      }
    table << "1, 5, 0, 0, 0.02, 200 # straight\n1, 5, 0, 4, 0.02, 200\n";
    coordinates << "5 0 0 5 0 4\n";
    connectivity << number << ' ' << number + 1;

    const auto array = [](const std::string &type,
                          const std::string &name,
                          const std::string &values) {
      return "<DataArray type=\"" + type + "\" Name=\"" + name +
             "\" format=\"ascii\"" +
             (name == "points" ? " NumberOfComponents=\"3\">" : ">") + values +
             "</DataArray>\n";
    };
    const std::string offsets =
      std::to_string(n + 1) + " " + std::to_string(n + 3);
    std::string radii;
    for (unsigned int k = 0; k <= n; ++k)
      radii += "0.03 ";
    const std::string data =
      "<PointData>" + array("Float64", "radius", radii + "0.02 0.02") +
      "</PointData>\n<CellData>" +
      array("Float64", "young_modulus", "100 200") + "</CellData>\n<Points>" +
      array("Float64", "points", coordinates.str()) + "</Points>\n";
    const std::string cells =
      array("Int64", "connectivity", connectivity.str()) +
      array("Int64", "offsets", offsets);
    const std::string n_points = std::to_string(n + 3);
    std::ofstream("lines/two.vtp")
      << "<VTKFile type=\"PolyData\" version=\"1.0\"><PolyData><Piece "
         "NumberOfPoints=\""
      << n_points << "\" NumberOfLines=\"2\">" << data << "<Lines>" << cells
      << "</Lines></Piece></PolyData></VTKFile>\n";
    std::ofstream("lines/two.vtu")
      << "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\">"
         "<UnstructuredGrid><Piece NumberOfPoints=\""
      << n_points << "\" NumberOfCells=\"2\">" << data << "<Cells>" << cells
      << array("UInt8", "types", "4 4")
      << "</Cells></Piece></UnstructuredGrid></VTKFile>\n";
  }

  void
  check_files(Checks &checks)
  {
    write_files();
    const std::string rest = "set Elements per fiber = 20\n";
    const FiberSet    typed =
      build(rest +
            "set Interpolation = smooth\nset Radius = 0.03, 0.02\n"
            "set Young modulus = 100, 200\nset Polylines = " +
            helix_points(60, ", ") + "; 5 0 0, 5 0 4");
    for (const std::string kind : {"csv", "vtp", "vtu"})
      checks.below(kind + " against the same as polylines",
                   difference(build(rest + "set File = lines/two." + kind),
                              typed),
                   1e-13);
  }

  /** What VTK itself has written: each way to store numbers, in um and GPa. */
  void
  check_encodings(Checks &checks)
  {
    const std::string rest =
      "set Elements per fiber = 4\nset Interpolation = straight\n";
    const FiberSet typed =
      build(rest + "set Radius = 0.008, 0.009\nset Young modulus = 73000, "
                   "70000\nset Polylines = 0 0 0, 0.5 0.1 0, 1 0 0; 0 0 1, "
                   "1 0 1");
    for (const std::string name : {"none_inline_wide_little.vtp",
                                   "none_raw_narrow_big.vtu",
                                   "zlib_inline_wide_big.vtp",
                                   "zlib_raw_narrow_little.vtu",
                                   "lz4_base64_wide_big.vtp",
                                   "lzma_inline_narrow_little.vtu"})
      {
        const FiberSet set = build(rest + "set File = " FIBER_FILES "/" + name);
        checks.below(name + " against the same as polylines",
                     difference(set, typed),
                     1e-13);
        checks.that(name + ": an array that is not read is told",
                    set.notes.size() == 1 &&
                      set.notes[0].find("displacement") != std::string::npos);
      }
  }

  /** Headings with units, and columns that are not asked for. */
  void
  check_units(Checks &checks)
  {
    const std::string rest =
      "set Elements per fiber = 4\nset Interpolation = straight\n";
    const FiberSet typed =
      build(rest + "set Radius = 0.008\nset Young modulus = 73000\n"
                   "set Polylines = 0.1 0.2 0, 0.6 0.2 0.3");
    for (const std::string heading :
         {"fiber,x[m],y[m],z[m],radius[m],young_modulus[Pa]|1e-4,2e-4,0,8e-6,"
          "73e9|6e-4,2e-4,3e-4,8e-6,73e9",
          "\xef\xbb\xbf"
          "fiber,x (um),y [\u00b5m],z[\u03bcm],radius[nm],young_modulus[GPa]|"
          "100,200,0,8000,73|600,200,300,8000,73",
          "fiber[-],x[cm],y[mm],z,radius[um],young_modulus[N/mm^2]|0.01,0.2,0,"
          "8,73000|0.06,0.2,0.3,8,73000"})
      {
        std::string rows = heading;
        for (std::size_t bar; (bar = rows.find('|')) != std::string::npos;)
          rows.replace(bar, 1, "\r\n0,");
        std::ofstream("units.csv") << rows;
        checks.below("units of " + heading.substr(heading.find('x'), 9),
                     difference(build(rest + "set File = units.csv"), typed),
                     1e-13);
      }

    std::ofstream("units.csv")
      << "fiber,x,y,z,tex[g/km],\x1b[31m,tex\n0,0,0,0,one,,2\n0,1,0,0,1,1,1\n";
    const FiberSet set = build("set File = units.csv");
    checks.that("columns that are not read are told once",
                set.notes.size() == 1 &&
                  set.notes[0].find("tex, ") != std::string::npos);
  }

  void
  check_bundle(Checks &checks)
  {
    for (const unsigned int n : {1u, 7u, 19u, 61u})
      {
        const FiberSet set =
          build("set Arrangement = bundle\nset Radius = 0.008\n"
                "subsection Bundle\nset Fibers = " +
                std::to_string(n) + "\nset Length = 2\nset Spacing = 2.1\nend");
        unsigned int n_neighbors = 0;
        double       least       = 1e300;
        for (const Fiber &a : set.fibers)
          for (const Fiber &b : set.fibers)
            if (&a != &b)
              {
                const double distance =
                  (a.centers[3] - b.centers[3]).norm() / .008;
                least = std::min(least, distance);
                n_neighbors += distance < 2.1 + 1e-9;
              }
        const std::string name = "bundle of " + std::to_string(n);
        checks.equal(name + ": fibers", set.fibers.size(), n);
        if (n > 1)
          checks.equal(name + ": spacing over r", least, 2.1);
        // a hexagon of k rings has 9 k^2 + 3 k pairs of neighbors
        const double rings = (std::sqrt(12. * n - 3) - 3) / 6;
        checks.equal(name + ": pairs of neighbors",
                     n_neighbors / 2.,
                     9 * rings * rings + 3 * rings);
        checks.equal(name + ": length",
                     set.fibers.back().centers.back()[0] -
                       set.fibers.back().centers.front()[0],
                     2);
      }
  }

  void
  check_strand(Checks &checks)
  {
    const std::string rest =
      "set Arrangement = strand\nset Radius = 0.11, 0.1\n"
      "set Young modulus = 300, 200\nset Elements per fiber = 30\n"
      "subsection Strand\nset Length = 5\nset ";
    const FiberSet set  = build(rest + "Lay angle = 0.2\nend");
    const Fiber   &core = set.fibers[0];
    checks.equal("strand: fibers", set.fibers.size(), 7);
    checks.equal("strand: radius of the core", core.radius, .11);
    checks.equal("strand: modulus of an outer fiber",
                 set.fibers[4].young_modulus,
                 200);
    double off_touch = 0, off_angle = 0, off_hand = 0;
    for (unsigned int f = 1; f < 7; ++f)
      for (unsigned int n = 0; n < core.centers.size(); ++n)
        {
          Vector3 arm         = set.fibers[f].centers[n];
          arm[0]              = 0;
          const Vector3 along = tangent(set.fibers[f], n);
          off_touch           = std::max(off_touch, std::abs(arm.norm() - .21));
          off_angle = std::max(off_angle, std::abs(along[0] - std::cos(.2)));
          off_hand =
            std::max(off_hand,
                     std::abs(Vector3::UnitX().cross(arm).dot(along) / .21 -
                              std::sin(.2)));
        }
    checks.below("strand: outer fibers off the core", off_touch, 1e-12);
    checks.below("strand: off the lay angle", off_angle, 1e-12);
    checks.below("strand: off a right-handed lay", off_hand, 1e-12);

    std::ostringstream length;
    length << std::setprecision(17) << 2 * M_PI * .21 / std::tan(.2);
    checks.below(
      "strand: by the lay length",
      difference(build(rest + "Lay length = " + length.str() + "\nend"), set),
      1e-12);
  }
} // namespace

int
main()
{
  std::ofstream output("output");
  Checks        checks(output);
  check_curves(checks);
  check_smooth_lines(checks);
  check_files(checks);
  check_encodings(checks);
  check_units(checks);
  check_bundle(checks);
  check_strand(checks);
}
