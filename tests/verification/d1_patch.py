# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""D1: straight fibers through a prism of matrix, the same strain on both.

Reference: rule of mixtures, N = (E_m A_m + sum E_f A_f) s(s^2 - 1)/2 at the stretch s (Saint Venant-Kirchhoff), where A_m
is the whole prism, as fibers and hexahedra overlap. Junctions carry nothing.
"""

import math

from check import Bound, Check

QUICK = True
YOUNG, RADIUS, STRETCH = 73000., .008, 1.01
AREA = .12 * (.04 + 2 * .008 + 2 * .012)


def judge(run):
    iterations = []
    for contrast in (1, 1e2, 1e4, 1e6):
        matrix = YOUNG / contrast
        for stiffness in (0, 1e3):
            result = run(f"Matrix/Young modulus={matrix:.12g}", f"Matrix/Junction stiffness={stiffness:g}")
            exact = (matrix * AREA + 4 * YOUNG * math.pi * RADIUS ** 2) * STRETCH * (STRETCH ** 2 - 1) / 2
            springs = f"{stiffness:g} MPa" if stiffness else "of the modulus"
            yield Check(f"force [N] at E_f/E_m = {contrast:g}, junctions {springs}", exact, result.last["force_right[N]"], 1e-8)
            iterations.append(result.newton_iterations)
    yield Bound("most over fewest Newton iterations", max(iterations) / min(iterations), most=2)
