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

  LoadingCurve curve;
  curve.append({0, "relax", 1, .5}, {{"energy[N.mm]", 1. / 3}});
  curve.append({0, "relax", 2, 1}, {{"energy[N.mm]", .25}});
  curve.append({1, "biaxial", 1, .1},
               {{"strain_warp", .002}, {"force_warp[N]", 4}});
  curve.append({1, "biaxial", 2, .3},
               {{"strain_warp", .006}, {"force_warp[N]", 13}});
  curve.append({2, "relax", 1, 1},
               {{"energy[N.mm]", std::numeric_limits<double>::quiet_NaN()}});
  out << curve.str() << "\n";

  const std::vector<std::string> stages = {"relax", "biaxial", "relax"};
  LoadingCurve                   continued;
  continued.continue_from(curve.str(), stages, 1, 1);
  continued.append({1, "biaxial", 2, .2},
                   {{"strain_warp", .004}, {"force_fill[N]", 7}});
  out << continued.str() << "\n";
  out << "same text when nothing is dropped ";
  LoadingCurve same;
  same.continue_from(curve.str(), stages, 2, 1);
  out << (same.str() == curve.str()) << "\n";

  // A run that went on in a fresh directory has no rows of the stages before.
  LoadingCurve fresh, again;
  fresh.append({1, "biaxial", 1, .1}, {{"force_warp[N]", 4}});
  fresh.append({1, "biaxial", 2, .2}, {{"force_warp[N]", 5}});
  again.continue_from(fresh.str(), stages, 1, 1);
  out << "rows of a file that begins late " << again.loads(1).size() << "\n";

  const std::string picture = curve_picture(curve, 1);
  out << "picture names the force "
      << (picture.find("force warp [N]") != std::string::npos)
      << ", the strain " << (picture.find("strain warp") != std::string::npos)
      << "; none of one point " << curve_picture(curve, 2).empty() << "\n";

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
