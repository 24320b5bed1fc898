# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""C5: stiffness of a twisted yarn of 7 filaments over that of its parallel filaments.

Reference: (1 + 6 cos^3(theta))/7, theta the angle of the outer filaments' axes, without lateral strain. Filaments that
fit around a core of the same radius would overlap; the core here is thicker by as little as keeps them apart.
"""

import math

from check import Check

QUICK = False
RADIUS, YOUNG_MODULUS, STRAIN = .008, 73000., .002

# inclination of the surface [degrees]: core over outer radius, stiffness ratio
REFERENCE = {10: (1.02, .982536), 20: (1.06, .929513), 30: (1.12, .839574)}


def judge(run):
    for degrees, (core, ratio) in REFERENCE.items():
        lay_angle = math.atan(2 / 3 * math.tan(math.radians(degrees)))
        result = run(f"Fibers/Radius={core * RADIUS}, {RADIUS}", f"Fibers/Strand/Lay angle={lay_angle}")
        stiffness = YOUNG_MODULUS * math.pi * RADIUS ** 2 * (core ** 2 + 6)
        yield Check(f"EA ratio at {degrees} degrees, penetration {result.penetration:.4f} r", ratio,
                    result.last["force_end[N]"] / STRAIN / stiffness, .02)
