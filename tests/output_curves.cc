// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// The loading curve takes up the columns of later stages, and a restart
// forgets what lies beyond it, also where a stage comes twice.

#include <fiberloom/base/exceptions.h>

#include <fiberloom/output/curves.h>

#include <fstream>
#include <limits>

using namespace fiberloom;

int
main()
{
  std::ofstream out("output");

  const Column energy{"energy", Quantity::energy};
  const Column strain{"strain_warp", Quantity::strain, Role::deformation};
  const Column warp{"force_warp", Quantity::force, Role::response};
  const Column fill{"force_fill", Quantity::force, Role::response};
  LoadingCurve curve;
  curve.append({0, "relax", 1, .5}, {{energy, 1. / 3}});
  curve.append({0, "relax", 2, 1}, {{energy, .25}});
  curve.append({1, "biaxial", 1, .1}, {{strain, .002}, {warp, 4}});
  curve.append({1, "biaxial", 2, .3}, {{strain, .006}, {warp, 13}});
  curve.append({2, "relax", 1, 1},
               {{energy, std::numeric_limits<double>::quiet_NaN()}});
  out << curve.str() << "\n";

  const std::vector<std::string> stages = {"relax", "biaxial", "relax"};
  LoadingCurve                   continued;
  continued.continue_from(curve.str(), stages, 1, 1);
  continued.append({1, "biaxial", 2, .2}, {{strain, .004}, {fill, 7}});
  out << continued.str() << "\n";
  out << "same text when nothing is dropped ";
  LoadingCurve same;
  same.continue_from(curve.str(), stages, 2, 1);
  out << (same.str() == curve.str()) << "\n";

  // A run that went on in a fresh directory has no rows of the stages before.
  LoadingCurve fresh, again;
  fresh.append({1, "biaxial", 1, .1}, {{warp, 4}});
  fresh.append({1, "biaxial", 2, .2}, {{warp, 5}});
  again.continue_from(fresh.str(), stages, 1, 1);
  out << "rows of a file that begins late " << again.loads(1).size() << "\n";

  const std::string picture = curve_picture(curve, 1);
  out << "picture names the force "
      << (picture.find("force warp [N]") != std::string::npos)
      << ", the strain " << (picture.find("strain warp") != std::string::npos)
      << "; none of one point " << curve_picture(curve, 2).empty() << "\n";

  // A restart brings its columns along; headings alone are not drawn.
  out << "continued without its columns there is "
      << (curve_picture(same, 1).empty() ? "no picture" : "a picture");
  same.continue_columns(curve.described_columns());
  out << ", with them the same "
      << (curve_picture(same, 1) == curve_picture(curve, 1)) << "\n";

  // Over an angle moments are drawn, over a length forces: six, none zero.
  for (const Quantity abscissa : {Quantity::angle, Quantity::length})
    {
      LoadingCurve many;
      for (const unsigned int increment : {0, 1})
        {
          CurveRow row{{{"moved", abscissa, Role::deformation}, 1. * increment},
                       {{"couple", Quantity::moment, Role::response},
                        1. * increment},
                       {{"nothing", Quantity::force, Role::response}, 0}};
          for (unsigned int i = 0; i < 8; ++i)
            row.push_back(
              {{"pull_" + std::to_string(i), Quantity::force, Role::response},
               1. * i * increment});
          many.append({0, "load", increment, 1. * increment}, row);
        }
      const std::string drawn = curve_picture(many, 0);
      out << "over " << name_of(abscissa) << ":";
      for (const std::string line :
           {"couple", "nothing", "pull 0", "pull 1", "pull 2", "pull 7"})
        if (drawn.find(line) != std::string::npos)
          out << " " << line;
      out << "\n";
    }

  try
    {
      continued.continue_from("time,force\n1,2\n", stages, 1, 1);
    }
  catch (const InputError &error)
    {
      out << error.what() << "\n";
    }

  // One stage after another of the same name, of one increment each.
  const std::vector<std::string> twice = {"relax", "relax"};
  IncrementTable bodies("reactions.csv", "body"), former = bodies;
  for (const unsigned int stage : {0, 1})
    for (const char *body : {"left", "right"})
      bodies.append({stage, "relax", 1, 1}, body, {{"force_x[N]", "3"}});
  out << "rows of two bodies " << bodies.rows().size() << "\n";
  former.continue_from(bodies.str(), twice, 1, 1);
  out << "and of the former file " << former.rows().size();
  former.continue_from(bodies.str(), twice, 0, 1);
  out << ", each stage with its own "
      << (former.rows().size() == 2 && former.rows()[1].key == "right") << "\n";
}
