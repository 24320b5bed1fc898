# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""Weaves small random fabrics and counts wrong ones and crashes.

Fabric N of a seed is always the same, whatever the number of fabrics, so that one that
is wrong can be woven again from what is printed. What the program says of its crossings
is not enough: the axes that it wrote are measured here as well. Each warp fiber has to
pass each fill fiber, on the side that the pattern gives, and no two axes come nearer
than surfaces that press each other.
"""

import argparse
import collections
import concurrent.futures
import itertools
import math
import os
import random
import shutil
import subprocess
import time

from verify import RunFailed, Runner

SCENE = "../../tests/scenes/small_weave"
NEAREST = .9  # distance of two axes over the sum of the radii, .98 where the program presses as it should
POINTS = 4  # a radius, along an axis
ROUNDING = 1e-9  # axes may cross just where segments meet: both have it then


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


def axes(result):
    """Points of each centre line, by family, tow and fiber."""
    found = collections.defaultdict(list)
    for row in result.table("trajectories.csv"):
        if row["kind"] == "fiber":
            found[row["family"], int(row["tow"]), int(row["fiber"])].append([row[f"{x}[mm]"] for x in "xyz"])
    return found


def dense(points, spacing):
    """The parabolas through the points of each element, two and the next one's first, as points."""
    for a, b, c in zip(points[:-2:2], points[1::2], points[2::2]):
        n = max(2, math.ceil(math.dist(a, c) / spacing))
        for t in (i / n for i in range(n)):
            weights = (1 - t) * (1 - 2 * t), 4 * t * (1 - t), t * (2 * t - 1)
            yield [sum(w * p[k] for w, p in zip(weights, (a, b, c))) for k in range(3)]


def nearest(lines, radii):
    """Least distance of two axes over the sum of their radii, where it is below 1, and which ones."""
    reach = 2 * max(radii.values())
    cells = collections.defaultdict(list)
    for name, points in lines.items():
        for point in dense(points, radii[name[0]] / POINTS):
            cells[tuple(math.floor(x / reach) for x in point)].append((name, point))
    least = 1, ()
    for cell, here in cells.items():
        around = [near for step in itertools.product((-1, 0, 1), repeat=3)
                  for near in cells.get(tuple(map(sum, zip(cell, step))), ())]
        for (name, point), (other, there) in itertools.product(here, around):
            if name < other:
                least = min(least, (math.dist(point, there) / (radii[name[0]] + radii[other[0]]), (name, other)))
    return least


def heights(warp, fill):
    """Heights of a warp fiber over a fill fiber where they cross, seen from above."""
    for (a, b), (c, d) in itertools.product(itertools.pairwise(warp), itertools.pairwise(fill)):
        u, v, w = ([q[k] - p[k] for k in range(3)] for p, q in ((a, b), (c, d), (a, c)))
        area = u[0] * v[1] - u[1] * v[0]
        if area:
            s, t = (w[0] * v[1] - w[1] * v[0]) / area, (w[0] * u[1] - w[1] * u[0]) / area
            if -ROUNDING <= min(s, t) and max(s, t) <= 1 + ROUNDING:
                yield a[2] + s * u[2] - c[2] - t * v[2]


def fault(lines, rows, radii):
    """What is wrong with the axes of a fabric, or nothing."""
    distance, names = nearest(lines, radii)
    if distance < NEAREST:
        return f"axes of {names} at {distance:.2f} of the radii"
    tows = {family: sorted({name[1] for name in lines if name[0] == family}) for family in radii}
    for warp, fill in itertools.product(*([name for name in lines if name[0] == family] for family in ("warp", "fill"))):
        above = rows[tows["fill"].index(fill[1])][tows["warp"].index(warp[1])] == "1"
        found = list(heights(lines[warp], lines[fill]))
        if not found or any((height > 0) != above for height in found):
            return f"{warp} over {fill} at {found}, wanted {'above' if above else 'below'}"
    return ""


def woven(number, arguments, names, verdict_of):
    """Verdict on a fabric, and what the program said to it."""
    runner = Runner("weaves", argparse.Namespace(work=os.path.join(arguments.work, str(number)),
                                                 program=arguments.program, ranks=1))
    entries = settings(arguments.seed, number)
    given = dict(entry.split("=") for entry in entries)
    try:
        result = runner(*entries, scene=SCENE)
        wrong = any(stage["crossings_out_of_order"] for stage in result.summary["stages"])
        said = fault(axes(result), given["Fabric/Pattern"].split(),
                     {family.lower(): float(given[f"Fabric/{family}/Fiber radius"]) for family in ("Warp", "Fill")})
        found = "wrong" if wrong or said else "in order", said and f" {said}"
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
