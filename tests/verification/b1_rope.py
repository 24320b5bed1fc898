# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""B1: two straight beams twisted by one turn into a rope that is one helix.

Reference: helices of Saint Venant-Kirchhoff beams without torsion, svk_helix.py, with data of a test of 4C
after Meier, Popp, Wall, Comput. Methods Appl. Mech. Engrg. 308 (2016); the bound of the radius is the error
of its solution with 8 elements.
"""

import math

from check import Bound, Check

QUICK = False
FORCE, TORQUE, RADIUS, PENETRATION = 6377.303, .7218303, .0095, .001
LINE_STIFFNESS = 47085.55
ENDS = ("left_end", "right_end")


def torque(row):
    """About the axis of the rope."""
    return sum(row[f"{end}_moment_z[N.mm]"] + row[f"{end}_x[mm]"] * row[f"{end}_force_y[N]"]
               - row[f"{end}_y[mm]"] * row[f"{end}_force_x[N]"] for end in ENDS)


def radius_error(row):
    """The largest at three points, over the penetration."""
    radii = [math.hypot(row[f"probe_0_at_{at}_x[mm]"], row[f"probe_0_at_{at}_y[mm]"]) for at in ("0.25", "0.375", "0.5")]
    return max(abs(radius - RADIUS) for radius in radii) / PENETRATION


def judge(run):
    results = {n: run(f"Fibers/Elements per fiber={n}") for n in (8, 16)}
    errors = {n: radius_error(result.last) for n, result in results.items()}
    for n, result in results.items():
        yield Check(f"rope force [N], {n} elements, penetration {result.penetration:.4f} r", FORCE,
                    sum(result.last[f"{end}_force_z[N]"] for end in ENDS), 5e-3)
        yield Check(f"torque [N mm], {n} elements", TORQUE, torque(result.last), 5e-3)
    yield Bound("error of the helix radius over the penetration, 16 elements", errors[16], most=.0042)
    yield Bound("its order with elements, 8 to 16", math.log2(errors[8] / errors[16]), least=2)
    stiffer = run("Fibers/Elements per fiber=16", f"Contact/Line stiffness={4 * LINE_STIFFNESS}").last
    pressed = 2 * RADIUS + PENETRATION  # axes of two beams that do not penetrate
    gaps = [pressed - 2 * math.hypot(row["probe_0_at_0.5_x[mm]"], row["probe_0_at_0.5_y[mm]"])
            for row in (results[16].last, stiffer)]
    yield Bound("order of the penetration with the line stiffness", math.log(gaps[0] / gaps[1], 4), least=.95)
    stations = [radius_error(run("Fibers/Elements per fiber=16", f"Contact/Stations per element={n}").last) for n in (1, 4)]
    yield Bound("its change from 1 to 4 stations per element", abs(stations[1] - stations[0]), most=.0005)
