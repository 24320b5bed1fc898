# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""D3: a short fiber, loaded by its matrix through the junctions.

Reference: mean of N(x) = N_inf [1 - cosh bx / cosh(bL/2)], b^2 = k_s (1/E_f A_f + 1/E_m A_m), over N_inf; Cox's shear lag
for a square packing (E_f/E_m = 23.33, nu_m = .35, V_f = .3), where the matrix is strained evenly: here much more of it.
"""

import math

from check import Check

QUICK = True
YOUNG, RADIUS, CONTRAST, POISSON, REACH, STRAIN = 73000., .01, 23.33, .35, 1.618022, 1e-6


def efficiency(run, length, width, thickness):
    """Mean force of the fiber over that in a long one, computed and in closed form."""
    result = run(f"Fibers/Polylines=0 0 0, {length:g} 0 0", f"Matrix/Size along y={width:.12g}",
                 f"Matrix/Thickness={thickness - RADIUS:.12g}", f"Drive right/Translation={STRAIN * length:g}*t; 0; 0",
                 f"Matrix/Junction spacing={length / 500:g}", "Matrix/Poisson ratio=0", "Matrix/Law=Saint Venant-Kirchhoff",
                 f"Matrix/Junction stiffness={spring():.12g}")
    matrix = YOUNG / CONTRAST * width * 2 * thickness
    fiber = YOUNG * math.pi * RADIUS ** 2
    force = result.last["right_force_x[N]"]
    mean = force - matrix * STRAIN * (1 + 1.5 * STRAIN)
    half = .5 * length * math.sqrt(spring() * (1 / fiber + 1 / matrix))
    return mean / (force * fiber / (fiber + matrix)), 1 - math.tanh(half) / half


def spring():
    return 2 * math.pi * YOUNG / CONTRAST / (2 * (1 + POISSON)) / math.log(REACH)


def judge(run):
    width = RADIUS * math.sqrt(math.pi / .3)
    computed, exact = efficiency(run, 1, width, width / 2)
    yield Check("mean force in a bar with V_f = 0.3, L/r = 100", exact, computed, 2e-2)
    for slenderness, cox in ((100, .92213), (20, .61522)):
        computed, _ = efficiency(run, slenderness * RADIUS, 6, 3)
        yield Check(f"Cox's efficiency at L/r = {slenderness}", cox, computed, 2e-2)
    by_modulus = run(scene="d3_short_fiber").last["right_force_x[N]"]
    given = run(f"Matrix/Junction stiffness={spring():.12g}").last["right_force_x[N]"]
    yield Check("force with junctions of the modulus over that with Cox's stiffness given", 1, by_modulus / given, 1e-6)
