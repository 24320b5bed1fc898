# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""Fibers that break: the same on 2 ranks, after a restart, and where increments are rolled back; what is written."""

import csv
import json
import os
import sys

from program_runs import SMALL_WEAVE, SOURCE, check, check_same, curve, finish, run

BUNDLE = os.path.join(SOURCE, "prm", "gallery", "breaking_bundle.prm")
FEW = ["Fibers/Bundle/Fibers=7", "Fibers/Elements per fiber=2", "Load/First step=0.1", "Load/Largest step=0.1",
       "Solver/Error estimate=false", "Output/Pictures=false"]


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

    # Stage by stage, from the checkpoint, what is broken stays so and more breaks.
    twice = [*FEW, "Drive end/Translation=0.075*t; 0; 0"]
    check_run("two stages", "twice", *twice, "Stages=load, load")
    check_run("the first of them", "parts", *twice, "Stages=load")
    halfway = len(breaks("parts"))
    check_run("the second", "parts", *twice, "Stages=load, load", restart=os.path.join("parts", "checkpoint"))
    check_equal(f"from {halfway} breaks on", "twice", "parts")
    check("breaks in both stages", 0 < halfway < len(breaks("twice")))

    # Too few iterations for the balance of a whole bundle that breaks.
    few_iterations = [*FEW, "Solver/Largest Newton iterations=6", "Load/Largest step=1"]
    check_run("rolled back", "large", *few_iterations, "Load/First step=1", status=2)
    first = curve("large")[1]["load"]
    check_run("not rolled back", "small", *few_iterations, f"Load/First step={first}", status=2)
    with open(os.path.join("large", "log.txt")) as log:
        check("breaks were rolled back", "breaks at load 1.0000: 7, 7 in all" in log.read().split("load       1")[0])
    check_equal("rolled back", "small", "large")

    # Where fibers touch, too: what is broken carries no tension.
    strand = [*FEW[2:], "Fibers/Breaking strain=0.003", "Fibers/Strand/Outer fibers=3", "Fibers/Elements per fiber=8",
              "Drive start/Ends=all start", "Drive end/Ends=all end", "Load/Largest step=0.5"]
    check_run("strand", "strand", *strand, scene=os.path.join(SOURCE, "prm", "strand.prm"))
    forces = [row["force_end[N]"] for row in curve("strand")]
    check(f"forces of the strand: {forces}", summary("strand")["broken"] >= 4 and abs(forces[-1]) < 0.01 * max(forces))

    # Bent by weaving, fibers break where they are pressed on each other. With friction, pieces would go on to pull.
    weave = ["Biaxial/Largest strain=0.03", "Fabric/Warp/Breaking strain=0.027", "Contact/Friction coefficient=0",
             "Solver/Error estimate=false"]
    check_run("weave", "weave", *weave, scene=SMALL_WEAVE)
    row = curve("weave")[-1]
    check(f"broken: {row['broken']}, forces {row['force_warp[N]']} and {row['force_fill[N]']}",
          row["broken"] >= 12 and abs(row["force_warp[N]"]) < 0.01 * max(row["force_warp[N]"] for row in curve("weave")[2:]))
    finish()


sys.exit(main())
