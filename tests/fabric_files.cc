// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// What a fabric exports as paths is read back as the same fibers and tows, with
// the order of the weave found from their heights; tables that make no fabric
// are refused.

#include <fiberloom/base/exceptions.h>

#include <fiberloom/fabric/fiber_file.h>

#include <fiberloom/output/paths.h>

#include <algorithm>

#include "checks.h"
#include "woven_sample.h"

using namespace fiberloom;

namespace
{
  FiberSet
  read(const std::string &rows, const std::string &stages)
  {
    std::ofstream("paths.csv") << rows;
    return build_fiber_set(
      parsed_scene("set Stages = " + stages +
                   "\nsubsection Fibers\nset File = paths.csv\n"
                   "set Elements per fiber = 12\nend\n"));
  }

  void
  check_round_trip(Checks &checks)
  {
    const WovenSample sample;
    const FiberSet   &expected = sample.fibers;
    const FiberSet    found =
      read(paths_csv(sample.fibers, sample.mesh, sample.q), "relax, biaxial");

    checks.equal("fibers", found.fibers.size(), expected.fibers.size());
    checks.equal("tows", found.tows.size(), expected.tows.size());
    bool   same_tows = found.pattern.has_value(), same_order = same_tows;
    double beside = 0;
    for (std::size_t t = 0; same_tows && t < found.tows.size(); ++t)
      {
        const Tow &a = found.tows[t], &b = expected.tows[t];
        same_tows = a.family == b.family && a.number == b.number &&
                    a.fibers == b.fibers &&
                    std::abs(a.center - b.center) < 1e-6 &&
                    std::abs(a.half_width / b.half_width - 1) < 1e-3;
      }
    for (unsigned int w = 0; w < 2; ++w)
      for (unsigned int f = 0; f < 3; ++f)
        same_order = same_order && found.pattern->warp_above(w, f) ==
                                     expected.pattern->warp_above(w, f);
    for (std::size_t f = 0; f < found.fibers.size(); ++f)
      {
        const auto &line = sample.mesh.lines()[f];
        // Fill fibers had other nodes: their crests and ends are the same.
        for (unsigned int i = 0; i <= 4; ++i)
          {
            const Vector3 there = sample.q.segment<3>(
              9 * (line.first_node + i * line.n_elements / 2));
            beside =
              std::max(beside, (found.fibers[f].centers[6 * i] - there).norm());
          }
      }
    checks.that("tows are the same", same_tows);
    checks.that("warp and fill lie above where they did", same_order);
    checks.below("points beside theirs over the radius", beside / .008, .05);
  }

  std::string
  refusal(const std::string &rows, const std::string &stages = "relax")
  {
    try
      {
        read("fiber,tow,family,x,y,z\n" + rows, stages);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "none";
  }

  void
  check_refused(Checks &checks)
  {
    const std::string warp = "0,0,warp,-1,0,0\n0,0,warp,1,0,0\n";
    struct Case
    {
      std::string name, rows, words;
    };
    for (
      const auto &[name, rows, words] :
      {Case{"fill that is not there", warp, "1 warp tows and 0 fill tows"},
       {"tows at one height",
        warp + "1,1,fill,0,-1,0\n1,1,fill,0,1,0\n",
        "cross at the same height"},
       {"tows that do not cross",
        warp + "1,1,fill,3,-1,.1\n1,1,fill,3,1,.1\n",
        "do not cross"},
       {"a fiber that runs back",
        warp + "1,1,fill,0,1,.1\n1,1,fill,0,-1,.1\n",
        "does not run along y"},
       {"a tow of two families",
        warp + "1,0,fill,0,-1,.1\n1,0,fill,0,1,.1\n",
        "two families"},
       {"a tow left out",
        warp + "1,2,fill,0,-1,.1\n1,2,fill,0,1,.1\n",
        "tow = 2; allowed"},
       {"an unknown family",
        warp + "1,1,weft,0,-1,.1\n",
        "family = weft; allowed: warp, fill, none"},
       {"fill before warp",
        "0,0,fill,0,-1,.1\n0,0,fill,0,1,.1\n1,1,warp,-1,0,0\n1,1,warp,1,0,0\n",
        "behind one of the fill"},
       {"families of none, and relax",
        "0,0,none,-1,0,0\n0,0,none,1,0,0\n",
        "relax needs a fabric"}})
      checks.that(name + " is refused",
                  refusal(rows).find(words) != std::string::npos);
  }
} // namespace

int
main()
{
  std::ofstream output("output");
  Checks        checks(output);
  check_round_trip(checks);
  check_refused(checks);
}
