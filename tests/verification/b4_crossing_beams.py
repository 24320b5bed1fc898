# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""B4: crossing simply supported beams, pushed together.

Reference: F = d/(L1^3/48 E I1 + L2^3/48 E I2 + 1/K), with the secant stiffness K of two rigid
cylinders that cross at 90 degrees (closed form of case B2).
"""

import math

from check import Check

QUICK = False
PUSH, DIAMETER, LINE_STIFFNESS = .004, .02, 1.


def contact_force(penetration):
    d = DIAMETER - penetration
    x = math.sqrt(DIAMETER ** 2 - d ** 2)
    return LINE_STIFFNESS * d * (DIAMETER * math.asinh(x / d) - x)


def expected():
    inertia = math.pi * (DIAMETER / 2) ** 4 / 4
    beams = 2 ** 3 / (48 * 70000 * inertia) + 1.5 ** 3 / (48 * 30000 * inertia)
    least, most = 0., PUSH
    for _ in range(100):
        penetration = (least + most) / 2
        if penetration + beams * contact_force(penetration) < PUSH:
            least = penetration
        else:
            most = penetration
    stiffness = contact_force(penetration) / penetration
    return PUSH / (beams + 1 / stiffness)


def judge(run):
    result = run()
    force = result.last["contact_force_sum[N]"]
    yield Check(f"force [N], penetration {result.penetration:.4f} r", expected(), force, 1e-2)
