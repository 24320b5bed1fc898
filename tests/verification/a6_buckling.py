# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""A6: lateral buckling of a strip, and buckling of a clamped fiber by torque (Greenhill).

Reference: zeros of the Bessel function J(-1/4) and of tan x = x. A round fiber cannot buckle
sideways, so the strip is a pair of them, tied so that it is stiff in one plane and its E I and
G J across are those of the two fibers. A small load to the side makes a deflection w;
1/w goes to zero at the buckling load, and with the square of the load nearly along a straight
line: the parabola through the last three increments gives the load.
"""

import math

from check import Check

QUICK = True
YOUNG, POISSON, RADIUS = 73000, .22, .008
BENDING = YOUNG * math.pi * RADIUS**4 / 4  # E I [N mm^2]
STRIP = 20.


def buckling_load(rows):
    """From pairs of load and deflection."""
    total = 0
    for i, (load, deflection) in enumerate(rows):
        share = 1
        for j, (_, other) in enumerate(rows):
            if i != j:
                share *= (1 / other) / (1 / other - 1 / deflection)
        total += share * load**2
    return math.sqrt(total)


def judge(run):
    rows = [(-row["tip_force_z[N]"], abs(row["tip_y[mm]"])) for row in run(scene="a6_buckling_lateral").rows[-3:]]
    stiffness = 2 * BENDING / math.sqrt(1 + POISSON)  # sqrt(E I G J) of the two
    yield Check("lateral buckling, P L^2/sqrt(E I G J)", 4.0125993, buckling_load(rows) * STRIP**2 / stiffness, 1e-2)
    rows = [(row["t"], math.hypot(row["probe_0_at_0.5_y[mm]"], row["probe_0_at_0.5_z[mm]"]))
            for row in run(scene="a6_buckling_torque_clamped").rows[-3:]]
    yield Check("torque, clamped ends, M L/E I", 8.9868189, buckling_load(rows), 1e-2)
