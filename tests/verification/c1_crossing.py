# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""C1: equilibrium of two crossing yarns in which bending is negligible, T1 sin(theta1) = T2 sin(theta2).

Reference: statics; tensions from the reactions, angles from the positions of ends and crossing. From t = 0.5 on: before,
the length sqrt(EI/T) over which bending rounds the crossing is still some 5 % of the span.
"""

import math

from check import Check

QUICK = True


def pull_across(row, drive, probe):
    """Tension times the sine of the inclination of the chord from the end to the crossing [N]."""
    tension = math.hypot(*(row[f"{drive}_force_{axis}[N]"] for axis in "xyz"))
    chord = [row[f"{drive}_{axis}[mm]"] - row[f"{probe}_{axis}[mm]"] for axis in "xyz"]
    return tension * abs(chord[2]) / math.hypot(*chord)


def judge(run):
    result = run()
    for row in result.increments[1:]:
        yield Check(f"T1 sin(theta1) over T2 sin(theta2) at t = {row['t']:.2f}, penetration {result.penetration:.3f} r", 1,
                    pull_across(row, "lower", "probe_0_at_0.5") / pull_across(row, "upper", "probe_1_at_0.5"), .03)
