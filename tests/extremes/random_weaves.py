# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""Weaves small random fabrics and counts wrong crossings and crashes.

Fabric N of a seed is always the same, whatever the number of fabrics, so that one that
is wrong can be woven again from what is printed.
"""

import argparse
import concurrent.futures
import os
import random
import shutil
import subprocess
import time

from verify import RunFailed, Runner

SCENE = "../../tests/scenes/small_weave"


def settings(seed, number):
    """Pattern, tows, fibers, radii and spacings; spacings from nearly touching tows to loose ones."""
    draw = random.Random(f"{seed}/{number}")
    tows = {family: draw.randint(2, 4) for family in ("Warp", "Fill")}
    rows = ["".join(draw.choice("01") for _ in range(tows["Warp"])) for _ in range(tows["Fill"])]
    found = ["Stages=weave, relax", "Fabric/Pattern=" + " ".join(rows), "Fabric/Fill/Same as warp=false",
             "Accuracy=draft"]
    for family, n in tows.items():
        fibers = draw.randint(1, 4)
        radius = round(draw.uniform(.004, .012), 5)
        # As wide as all fibers side by side, at least ten radii: fibers have to get around others.
        width = max(2.06 * fibers, 10)
        spacing = round(radius * width * draw.uniform(1.5, 4), 5)
        found += [f"Fabric/{family}/{name}={value}" for name, value in
                  (("Tows", n), ("Fibers per tow", fibers), ("Fiber radius", radius), ("Tow spacing", spacing),
                   ("Elements per fiber", 0))]
    return found


def woven(number, arguments, names, verdict_of):
    """Verdict on a fabric, and what the program said to it."""
    runner = Runner("weaves", argparse.Namespace(work=os.path.join(arguments.work, str(number)),
                                                 program=arguments.program, ranks=1))
    try:
        result = runner(*settings(arguments.seed, number), scene=SCENE)
        wrong = any(stage["crossings_out_of_order"] for stage in result.summary["stages"])
        found = "wrong" if wrong else "in order", ""
    except RunFailed as failure:
        found = verdict_of(failure, names), f" status {failure.status}: {failure.message}"
    except subprocess.TimeoutExpired:
        found = "crashed", " no end"
    if found[0] == "in order":
        shutil.rmtree(runner.arguments.work)
    return found


def weave(arguments, names, verdict_of):
    counts = dict.fromkeys(("in order", "refused", "failed", "wrong", "crashed"), 0)
    start = time.time()
    numbers = range(arguments.first, arguments.first + arguments.weaves)
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as jobs:
        for number, (verdict, said) in zip(numbers, jobs.map(
                lambda number: woven(number, arguments, names, verdict_of), numbers)):
            counts[verdict] += 1
            print(f"{number} {verdict}{said}", flush=True)
            if verdict != "in order":
                print("   " + " ".join(f'--set "{entry}"' for entry in settings(arguments.seed, number)), flush=True)
    print(f"seed {arguments.seed}, {arguments.weaves} weaves from {arguments.first} on in {time.time() - start:.0f} s: "
          + ", ".join(f"{count} {verdict}" for verdict, count in counts.items()))
    return counts["wrong"] + counts["crashed"] > 0
