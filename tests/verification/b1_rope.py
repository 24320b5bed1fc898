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
    for n in (8, 16):
        row = results[n].last
        yield Check(f"rope force [N], {n} elements, penetration {results[n].penetration:.4f} r", FORCE,
                    sum(row[f"{end}_force_z[N]"] for end in ENDS), 5e-3)
        yield Check(f"torque [N mm], {n} elements", TORQUE, torque(row), 5e-3)
        yield Bound(f"error of the helix radius over the penetration, {n} elements", radius_error(row), most=.0042)
