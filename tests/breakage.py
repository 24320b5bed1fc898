# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""Fibers that break: the same on 2 ranks, after a restart, and where increments are rolled back; what is written."""

import csv
import json
import os
import sys

from program_runs import SCENES, SOURCE, check, check_same, curve, finish, run

BUNDLE = os.path.join(SOURCE, "prm", "gallery", "breaking_bundle.prm")
FEW = ["Fibers/Bundle/Fibers=7", "Fibers/Elements per fiber=2", "Load/First step=0.1", "Load/Largest step=0.1",
       "Solver/Error estimate=false", "Output/Pictures=false"]
TOUCHING = ["Fibers/Bundle/Spacing=2.02", "Load/End=0.6"]


def breaks(directory):
    with open(os.path.join(directory, "breaks.csv")) as rows:
        return [tuple(row[name] for name in ("stage", "increment", "fiber", "tow", "element"))
                for row in csv.DictReader(rows)]


def summary(directory):
    with open(os.path.join(directory, "summary.json")) as file:
        return json.load(file)["stages"][-1]


def check_run(what, directory, *settings, scene=BUNDLE, status=0, **options):
    done = run(scene, directory, *settings, **options)
    check(f"{what}: status {done.returncode} {done.stderr}", done.returncode == status)


def check_equal(what, one, other):
    check_same(f"{what}: curve", one, other, 1e-8)
    check(f"{what}: {len(breaks(other))} breaks", breaks(one) == breaks(other) and breaks(one))


def main():
    check_run("straight", "straight", *FEW)
    last = curve("straight")[-1]["broken"]
    check(f"broken: {last} in the curve", last == len(breaks("straight")) == summary("straight")["broken"] == 7)
    increments = {row[1]: int(row[1]) for row in breaks("straight")}
    check(f"breaks in increments {list(increments)}", len(increments) > 1)
    with open(os.path.join("straight", "log.txt")) as log:
        check("the log tells of breaks", "breaks at load" in log.read())

    check_run("2 ranks", "ranks", *FEW, ranks=2)
    check_equal("2 ranks", "straight", "ranks")

    # Stopped by a function that is not finite any more, between breaks.
    half = sorted(increments.values())[len(increments) // 2]
    load = curve("straight")[half - 1]["load"]
    stop = f"Drive end/Translation=if(t < {load + .01}, 0.1*t, 1/0); 0; 0"
    check_run("stopped", "stopped", *FEW, stop, status=1)
    finish()


sys.exit(main())
