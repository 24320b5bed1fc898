# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""A7: two fibers pressed on each other, turned as a whole by 10 to 350 degrees.

Reference: forces, moments and energy before the turn.
"""

import math

from check import Check

QUICK = False
AXIS = (0, .6, .8)


def turned(vector, angle):
    """About AXIS."""
    along = sum(a * v for a, v in zip(AXIS, vector))
    across = [AXIS[i - 2] * vector[i - 1] - AXIS[i - 1] * vector[i - 2] for i in range(3)]
    return [v * math.cos(angle) + c * math.sin(angle) + a * along * (1 - math.cos(angle))
            for a, v, c in zip(AXIS, vector, across)]


def change(result, angle_of, quantity, unit):
    """Largest, over the size of the vector, of what a drive exerts."""
    start = None
    largest = 0
    for row in result.increments:
        vector = turned([row[f"{quantity}_{axis}[{unit}]"] for axis in "xyz"], -angle_of(row))
        start = start or vector
        largest = max(largest, math.dist(vector, start) / math.hypot(*start))
    return largest


def judge(run):
    for friction in (0, .2):
        result = run(f"Contact/Friction coefficient={friction}")
        with_friction = f"friction {friction}, penetration {result.penetration:.4f} r"
        for drive in ("lower", "upper"):
            for quantity, unit in (("force", "N"), ("moment", "N.mm")):
                largest = change(result, lambda row: math.radians(10 * (row["t"] - 1)), f"{drive}_{quantity}", unit)
                yield Check(f"change of {quantity} of the {drive} fiber's ends, {with_friction}", 0, largest, 1e-10, absolute=True)
        for column in ("contact_force_sum[N]", "elastic_energy[N.mm]"):
            start = result.increments[0][column]
            largest = max(abs(row[column] / start - 1) for row in result.increments)
            yield Check(f"change of {column}, {with_friction}", 0, largest, 1e-10, absolute=True)
