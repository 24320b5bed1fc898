# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""B2: rigid straight cylinders that cross at any angle, 90 degrees to parallel.

Reference: line penalty across the bisector, F = k d cot(a/2) (D asinh(x/d) - x), where x is half the
width of the overlap, or where the cylinders end. Continuity: the ratio to it between neighboring angles.
"""

import math

from check import Bound, Check

QUICK = False
DIAMETER, PENETRATION, HALF_LENGTH = 1., .01, 100.
REFERENCE = {90: 9.376101e-4, 45: 2.263591e-3, 10: 1.071693e-2, 1: 1.074395e-1, .1: 1.074422}
SWEEP = [90, 80, 70, 60, 50, 45, 40, 36, 34, 32, 30, 28, 26, 24, 22, 20, 18, 16, 14, 12, 10, 8, 6, 4, 3, 2, 1.5, 1,
         .7, .5, .3, .2, .15, .1, .07, .05, .03, .01, 0]


def closed_form(angle):
    d = DIAMETER - PENETRATION
    if angle == 0:
        return 2 * HALF_LENGTH * PENETRATION
    half = math.tan(math.radians(angle) / 2)
    x = min(math.sqrt(DIAMETER ** 2 - d ** 2), 2 * HALF_LENGTH * half)
    return d / half * (DIAMETER * math.asinh(x / d) - x)


def force(run, angle):
    x = HALF_LENGTH * math.cos(math.radians(angle))
    y = HALF_LENGTH * math.sin(math.radians(angle))
    line = f"-100 0 0, 100 0 0; {-x:.9f} {-y:.9f} 1, {x:.9f} {y:.9f} 1"
    return run(f"Fibers/Polylines={line}").last["force_upper[N]"]


def judge(run):
    for angle, reference in REFERENCE.items():
        yield Check(f"force/k [mm^2] at {angle} degrees, penetration 0.02 r", reference, force(run, angle), 2e-2)
    yield Check("force/k [mm^2] where parallel", closed_form(0), force(run, 0), 2e-2)
    ratios = [force(run, angle) / closed_form(angle) for angle in SWEEP]
    jumps = [abs(b / a - 1) for a, b in zip(ratios, ratios[1:])]
    steepest = jumps.index(max(jumps))
    yield Bound(f"largest jump, between {SWEEP[steepest]} and {SWEEP[steepest + 1]} degrees", max(jumps), most=2e-2)
    yield Bound("largest distance from the closed form", max(abs(ratio - 1) for ratio in ratios), most=2e-2)
