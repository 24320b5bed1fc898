# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""D4: a layered strip whose ends turn against each other.

Reference: M = (EI)_c angle/L with (EI)_c = E_m b H^3/12 + sum E_f (I + A z^2) for a small angle; from there to 90 degrees
without a failed increment.
"""

import math

from check import Bound, Check

QUICK = True
YOUNG, RADIUS, Z, LENGTH = 73000., .008, .03, 2.
MATRIX, WIDTH, HEIGHT = 3000., .12, 2 * (.03 + .008 + .012)


def judge(run):
    result = run()
    area = math.pi * RADIUS ** 2
    stiffness = MATRIX * WIDTH * HEIGHT ** 3 / 12 + 4 * YOUNG * area * (RADIUS ** 2 / 4 + Z ** 2)
    rows = [row for row in result.increments if row["stage"] == "load"]
    angle = rows[0]["right_ry[rad]"] - rows[0]["left_ry[rad]"]
    yield Check(f"moment at {angle:.4f} rad over (EI)_c angle/L", 1, rows[0]["right_moment_y[N.mm]"] / (stiffness * angle / LENGTH), 1e-2)
    yield Bound("angle at the end [rad]", rows[-1]["right_ry[rad]"] - rows[-1]["left_ry[rad]"], least=1.57)
    yield Bound("rejected increments", sum(stage["rejected_increments"] for stage in result.summary["stages"]), most=0)
