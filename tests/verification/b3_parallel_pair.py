# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""B3: two parallel clamped beams whose clamps are moved into each other.

Reference: beam on an elastic foundation, beta^4 = k/2EI, closed form.
"""

import math

from check import Check

QUICK = False
LENGTH, RADIUS, YOUNG = 2., .01, 70000.

# beta L: deflection at mid-span over the overlap of the clamps
REFERENCE = {1: .00516656, 2: .07377552, 3: .25419457}


def judge(run):
    bending = YOUNG * math.pi * RADIUS ** 4 / 4
    for beta, deflection in REFERENCE.items():
        result = run(f"Contact/Line stiffness={2 * bending * (beta / LENGTH) ** 4:.10g}")
        overlap = -(result.last["upper_z[mm]"] - 2 * RADIUS)
        computed = -result.last["probe_0_at_0.5_z[mm]"] / overlap
        yield Check(f"w_mid/overlap at beta L = {beta}, penetration {result.penetration:.4f} r", deflection, computed, 1e-2)
