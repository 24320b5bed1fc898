# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""A fabric is measured and exported by a run, from its checkpoint without computing, and on two ranks,
with the same files; its paths are a fabric that relaxes to the same thickness and is pulled."""

import csv
import json
import os

from program_runs import SMALL_WEAVE, check, curve, finish, run

FILES = ["fibers.vtp", "paths.csv", "surface.stl", "surface.vtp", "texgen.xml", "voxels.inp", "voxels.vti"]
EXPORT = "Output/Export=surface, voxels, abaqus, paths, texgen, fibers"
WEAVE = ["Stages=weave, relax", "Solver/Error estimate=false"]


def content(directory, file):
    with open(os.path.join(directory, "export", file), "rb") as data:
        return data.read()


def fabric(directory):
    with open(os.path.join(directory, "summary.json")) as summary:
        return json.load(summary).get("fabric", {})


def points(directory):
    with open(os.path.join(directory, "export", "paths.csv")) as rows:
        return [[float(row[name]) for name in ("x[mm]", "y[mm]", "z[mm]")]
                for row in csv.DictReader(line for line in rows if line[0] != "#")]


def alike(one, other, tolerance):
    return len(one) == len(other) and all(abs(a - b) <= tolerance for p, q in zip(one, other) for a, b in zip(p, q))


woven = run(SMALL_WEAVE, "woven", EXPORT, *WEAVE)
check("a run exports", woven.returncode == 0 and sorted(os.listdir("woven/export")) == FILES)
measures = fabric("woven")
check("thickness is that of two tows and a little",
      .9 < measures["thickness[mm]"] / (measures["tow_height_warp[mm]"] + measures["tow_height_fill[mm]"]) < 1.1)
with open("woven/fabric.csv") as rows:
    table = list(csv.DictReader(rows))
check("fabric.csv has a row for each stage, the last in summary.json",
      [row["stage"] for row in table] == ["weave", "relax"] and
      all(float(table[-1][name]) == value for name, value in measures.items()))

run(SMALL_WEAVE, "plain", *WEAVE)
check("without Export there is none", not os.path.exists("plain/export"))
again = run(SMALL_WEAVE, "again", EXPORT, *WEAVE, restart="plain/checkpoint")
check("a checkpoint is exported without computing",
      again.returncode == 0 and "nothing is left to do" in again.stdout and " load " not in again.stdout)
check("with the same files", all(content("woven", file) == content("again", file) for file in FILES))
check("and the same measures", fabric("again") == measures)

ranks = run(SMALL_WEAVE, "ranks", EXPORT, *WEAVE, ranks=2)
check("two ranks export the same", ranks.returncode == 0 and sorted(os.listdir("ranks/export")) == FILES and
      alike(points("ranks"), points("woven"), 1e-8) and
      len(content("ranks", "voxels.inp").splitlines()) == len(content("woven", "voxels.inp").splitlines()))

with open("paths.prm", "w") as scene:
    scene.write("set Stages = relax, biaxial\nset Accuracy = draft\nsubsection Fibers\n"
                "set File = woven/export/paths.csv\nset Elements per fiber = 6\nset Stress free = straight\nend\n"
                "subsection Biaxial\nset Largest strain = 0.004\nset Largest step = 1\nset First step = 1\nend\n"
                "subsection Solver\nset Error estimate = false\nend\n"
                "subsection Output\nset Pictures = false\nset Slices = none\nset Fields every = 0\nend\n")
read = run("paths.prm", "read")
check("paths are a fabric that relaxes and is pulled", read.returncode == 0)
with open("read/fabric.csv") as rows:
    relaxed = next(csv.DictReader(rows))
check("at rest it is as thick and as heavy",
      abs(float(relaxed["thickness[mm]"]) / measures["thickness[mm]"] - 1) < .01 and
      abs(float(relaxed["areal_weight[kg/m2]"]) / measures["areal_weight[kg/m2]"] - 1) < 1e-3)

with open("woven/export/paths.csv") as paths, open("moved.csv", "w", newline="") as moved:
    rows = csv.DictReader(line for line in paths if line[0] != "#")
    table = csv.DictWriter(moved, rows.fieldnames)
    table.writeheader()
    table.writerows({**row, "x[mm]": float(row["x[mm]"]) + .3} for row in rows)
SHEAR = ["Stages=relax, shear", "Shear/Largest angle=.02", "Shear/Largest step=.02"]
check("and sheared, here and elsewhere",
      run("paths.prm", "here", *SHEAR).returncode == 0 and
      run("paths.prm", "elsewhere", *SHEAR, "Fibers/File=moved.csv").returncode == 0)
here, elsewhere = (float(curve(place)[-1]["shear_force[N]"]) for place in ("here", "elsewhere"))
check(f"by the same force, {here} and {elsewhere}", here > 0 and abs(elsewhere / here - 1) < 1e-4)

for setting, words in (("Output/Export=surface, stl", "is not allowed; allowed: list with commas of: surface, voxels"),
                       ("Output/Voxel size=1e-5", "voxels; allowed: at least some")):
    refused = run(SMALL_WEAVE, "refused", "Output/Export=voxels", setting)
    check(f"{setting} is refused in one line", refused.returncode == 1 and words in refused.stderr and
          refused.stderr.count("\n") == 1 and not os.path.exists("refused"))
finish()
