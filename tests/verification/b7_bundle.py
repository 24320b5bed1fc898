# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""B7: bending stiffness of straight bundles whose fibers stick, over that where they slide.

Reference: parallel axes, 1 + 4 sum(z^2) / (n r^2) against 1. Sticking has an elastic slip
of a thousandth of the radius; the cantilever is long enough for that not to count. Fibers
that slide just touch: clips that hold them pressed would stiffen the cantilever against
shear, and sticking is what needs the pressure.
"""

from check import Check

QUICK = False
# By friction coefficient: over the radius, and [N] such that each bends the cantilever little
SPACING = {0: 2, 1: 1.998}
FORCE_OF_FIBER = {0: 1e-6, 1: 1.4e-5}

REFERENCE = {2: 5, 3: 3.6667, 7: 7.8571, 19: 21.2105}


def hexagon(rings):
    """Places (y, z) of the fibers, in units of their spacing."""
    half = 3**.5 / 2
    return [(i + j / 2, j * half) for j in range(-rings, rings + 1) for i in range(-rings, rings + 1)
            if abs(i + j) <= rings]


PLACES = {2: [(0, -.5), (0, .5)], 3: [(-.5, 0), (.5, 0), (0, 3**.5 / 2)], 7: hexagon(1), 19: hexagon(2)}


def deflection(run, n, friction):
    places = [(SPACING[friction] * y, SPACING[friction] * z) for y, z in PLACES[n]]
    fibers = "; ".join(f"0 {y!r} {z!r}, 100 {y!r} {z!r}" for y, z in places)
    result = run(f"Fibers/Polylines={fibers}", f"Contact/Friction coefficient={friction}",
                 f"Drive tip/Force=0; 0; {FORCE_OF_FIBER[friction] * n!r}")
    start = sum(z for _, z in places) / n
    return (result.last["tip_z[mm]"] - start) / FORCE_OF_FIBER[friction], result.penetration


def judge(run):
    for n, ratio in REFERENCE.items():
        sliding, _ = deflection(run, n, 0)
        sticking, penetration = deflection(run, n, 1)
        yield Check(f"{n} fibers, penetration {penetration:.2g} r", ratio, sliding / sticking, .02)
