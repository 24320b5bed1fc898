# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""K2: hexagonal bundle of 7 glass fibers, clamped rigidly, turned by half a turn at fixed length.

Reference: two unrelated codes, of implicit rods and of discrete elements, which agree within 0.3 %. Their rods have no
axial force from twist; the solid sections of the program have one, EA (r phi')^2 (1/4 - nu/(2 + 2 nu)) a fiber, which is
added to the published force.
"""

import math

from check import Check, Report

QUICK = False
RADIUS, YOUNG_MODULUS, POISSON_RATIO, LENGTH = .008, 73000., .22, 1.
TOLERANCE = .01


def twist_tension():
    """Axial force of one fiber that is twisted by half a turn at fixed length [N]."""
    stiffness = YOUNG_MODULUS * math.pi * RADIUS ** 2
    return stiffness * (RADIUS * math.pi / LENGTH) ** 2 * (.25 - POISSON_RATIO / (2 + 2 * POISSON_RATIO))


def judge_bundle(run, fibers, force, moment, seconds):
    """Against the force [N] and the moment [N mm] of the two codes, beside their CPU seconds."""
    result = run()
    yield Report("CPU seconds", result.cpu_seconds, seconds)
    yield Check(f"Fz [N], penetration {result.penetration:.4f} r", force + fibers * twist_tension(),
                abs(result.last["twist_force_x[N]"]), TOLERANCE, published=force)
    yield Check("Mz [N.mm]", moment, abs(result.last["twist_moment_x[N.mm]"]), TOLERANCE)


def judge(run):
    yield from judge_bundle(run, 7, .12135, 4.3695e-3, "DisMech 1.2-3.8, Yade 6")
