# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""A6: lateral buckling of a strip, and buckling of a fiber by torque between ball joints and clamps (Greenhill).

Reference: zeros of the Bessel function J(-1/4), 2 pi, and zero of tan x = x. The slope of a fiber between clamps that can
move sideways obeys the equation and the end conditions of the deflection between ball joints, so that case is run in
their place: a torque that keeps its direction on a ball joint has no potential. A round fiber cannot buckle
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
    for ends, load in (("ball", 2 * math.pi), ("clamped", 8.9868189)):
        rows = [(row["t"], math.hypot(row["probe_0_at_0.5_y[mm]"], row["probe_0_at_0.5_z[mm]"]))
                for row in run(scene=f"a6_buckling_torque_{ends}").rows[-3:]]
        yield Check(f"torque, {ends} ends, M L/E I", load, buckling_load(rows), 1e-2)
