# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""Fabrics of 4 x 4 tows are in order, and no fiber passes through another.

The distances of fibers are measured on their centre lines as they come out, by
the distance of all pairs of straight pieces, without the program's contacts.
"""

import csv
import json
import os
import sys
from itertools import combinations

from program_runs import SMALL_WEAVE, check, finish, run

RADIUS = .008


def centre_lines(directory):
    """A list of points for each fiber."""
    lines = {}
    with open(os.path.join(directory, "trajectories.csv")) as file:
        for row in csv.DictReader(file):
            if row["kind"] == "fiber":
                point = tuple(float(row[axis]) for axis in ("x[mm]", "y[mm]", "z[mm]"))
                lines.setdefault(row["fiber"], []).append(point)
    return list(lines.values())


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def minus(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def clamp(value):
    return min(1., max(0., value))


def segment_distance(p, q, r, s):
    """Between the pieces pq and rs: closest points of the lines, clamped in turn."""
    u, v, w = minus(q, p), minus(s, r), minus(p, r)
    a, b, c, d, e = dot(u, u), dot(u, v), dot(v, v), dot(u, w), dot(v, w)
    slope = a * c - b * b
    along = clamp((b * e - c * d) / slope) if slope > 1e-12 * a * c else 0.
    other = (b * along + e) / c
    if not 0 <= other <= 1:
        other = clamp(other)
        along = clamp((b * other - d) / a)
    gap = tuple(w[i] + along * u[i] - other * v[i] for i in range(3))
    return dot(gap, gap)**.5


def line_distance(one, other):
    """Smallest over all pieces; pieces too far apart by their ends are skipped."""
    smallest = 1e300
    for p, q in zip(one, one[1:]):
        length = dot(minus(q, p), minus(q, p))**.5
        for r, s in zip(other, other[1:]):
            reach = length + dot(minus(s, r), minus(s, r))**.5
            if dot(minus(p, r), minus(p, r)) < (reach + 4 * RADIUS)**2:
                smallest = min(smallest, segment_distance(p, q, r, s))
    return smallest


def check_fabric(pattern, fibers, *settings, least_distance=1.95):
    directory = f"{pattern.replace(' ', '_').replace('/', '')}_{fibers}{len(settings)}"
    done = run(SMALL_WEAVE, directory, "Stages=weave, relax", f"Fabric/Pattern={pattern}", "Fabric/Warp/Tows=4",
               f"Fabric/Warp/Fibers per tow={fibers}", "Fabric/Warp/Elements per fiber=24", *settings)
    check(f"{pattern}, {fibers} fibers a tow {settings}: status {done.returncode} {done.stderr}", done.returncode == 0)
    if done.returncode != 0:
        return
    with open(os.path.join(directory, "summary.json")) as file:
        summary = json.load(file)
    check("  converged", summary["converged"] and all(stage["converged"] for stage in summary["stages"]))
    last = summary["stages"][-1]
    check(f"  crossings out of order {last['crossings_out_of_order']}", last["crossings_out_of_order"] == 0)
    penetration = last["largest_penetration_over_radius"]
    check(f"  penetration {penetration:.4f} r", penetration <= .03)
    lines = centre_lines(directory)
    check(f"  fibers {len(lines)}", len(lines) == 8 * fibers)
    smallest = min(line_distance(one, other) for one, other in combinations(lines, 2)) / RADIUS
    check(f"  closest centre lines {smallest:.4f} r", least_distance <= smallest < 2.01)


def main():
    for pattern in ("plain", "twill 2/2"):
        for fibers in (1, 3):
            check_fabric(pattern, fibers)
    check_fabric("plain", 1, "Weaving/Path=nested")
    # So tight that closest points meet the kinks of bent centre lines at element ends. Sections are squeezed, too.
    check_fabric("plain", 1, "Weaving/Path=nested", "Fabric/Warp/Tow spacing=0.08", least_distance=1.9)
    finish()


sys.exit(main())
