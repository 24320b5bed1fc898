# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""D2: a fiber on the springs of its junctions in a rigid matrix.

Reference: pull-out KL/EA = bL tanh bL with b^2 = k_s/EA; beam on an elastic foundation (Hetenyi) with 1/l^4 = k_s/4EI,
semi-infinite under an end load F/w = k_s l/2, infinite under a load in the middle F/w = 2 k_s l.
"""

import math

from check import Check

QUICK = True
YOUNG, RADIUS, LENGTH, MOVE = 73000., .002, 1., 1e-5


def judge(run):
    axial = YOUNG * math.pi * RADIUS ** 2
    for ratio, exact in ((.01, .009967), (1, .761594), (100, 10.)):
        result = run(f"Matrix/Junction stiffness={ratio * axial / LENGTH ** 2:.12g}")
        yield Check(f"pull-out KL/EA at k L^2/EA = {ratio:g}", exact, result.last["pull_force_x[N]"] / MOVE * LENGTH / axial, 1e-2)

    length = .1  # l
    stiffness = YOUNG * math.pi * RADIUS ** 4 / length ** 4
    settings = f"Matrix/Junction stiffness={stiffness:.12g}"
    end = run(settings, scene="d2_foundation")
    yield Check("end load: F/w over k l/2", 1, end.last["pull_force_z[N]"] / MOVE / (.5 * stiffness * length), 1e-2)
    middle = run(settings, "Drive pull/Ends=0 at 0.5", scene="d2_foundation")
    yield Check("load in the middle: F/w over 2 k l", 1, middle.last["pull_force_z[N]"] / MOVE / (2 * stiffness * length), 1e-2)
