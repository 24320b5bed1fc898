# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""K3: plain weave of 4 x 4 single fibers, free of stress as woven, drawn out by 1 % in both directions.

Reference: planar Timoshenko rods (shear factor 0.9) with a rigid contact, by a boundary value solver. Their axial
force is linear, N = EA (lambda - 1); the program's fibers have N = EA lambda (lambda^2 - 1)/2, 1.5 % more at 1 %.
"""

from check import Check

QUICK = False
YARNS = 4
TENSION = .1418297  # N, of a yarn
CROSSING = 2.63556e-2  # N


def judge(run):
    for level, tolerance in (("draft", .10), ("standard", .02), ("fine", .005)):
        result = run(f"Accuracy={level}")
        what = f"{level}, penetration {result.penetration:.3f} r"
        yield Check(f"T [N] of a yarn, {what}", TENSION, result.last["force_warp[N]"] / YARNS, tolerance)
        yield Check(f"crossing force [N], {what}", CROSSING, result.last["largest_contact_force[N]"], tolerance)
