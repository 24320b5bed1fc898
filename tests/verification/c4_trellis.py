# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""C4: shear locking of a trellis, at the angle where neighbors lie side by side.

Reference: cos(angle) = w/p with the width w of a tow, here of a thick fiber, and the pitch p. The computed angle is that
at which the tangent at the end of the torque curve starts from zero.
"""

import math

from check import Bound, Check

QUICK = True
WIDTH, PITCH = .016, .024


def torque(row):
    return abs(row["warp_0_moment_z[N.mm]"] + row["warp_1_moment_z[N.mm]"])


def angle(row):
    return abs(row["warp_0_rz[rad]"])


def judge(run):
    result = run()
    before, last = result.rows[-2:]
    slope = (torque(last) - torque(before)) / (angle(last) - angle(before))
    locking = math.acos(WIDTH / PITCH)
    yield Check(f"locking angle [rad], penetration {result.penetration:.3f} r", locking, angle(last) - torque(last) / slope, .1)
    free = max(torque(row) for row in result.rows if angle(row) < .9 * locking)
    yield Bound("torque below 0.9 of that angle over the last one", free / torque(last), most=1e-3)
