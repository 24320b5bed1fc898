# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""B8: strand of a core and six wires without friction, stiffness at zero strain over that of straight wires.

Reference: energy of helical rods on a core that does not give way, strand_energy.py. It knows no contact
between the wires; six wires of the core's radius overlap, here they push each other outwards. So the
case is judged also with every other wire only, which do not touch: what is not the core's counts twice.
"""

import math

from check import Check

QUICK = False
STRAIN = 1e-3

# lay angle in degrees: ends that do not turn, ends free to turn
REFERENCE = {5: (.9902552, .9108858), 10: (.9615727, .7274858), 15: (.9155645, .5596589)}
COUPLING = 6.33701917  # at 10 degrees


def tangent(result, column):
    return (result.at("t", 2)[column] - result.at("t", 1)[column]) / STRAIN


def judge(run):
    for degrees, (fixed, free) in REFERENCE.items():
        lay = f"Fibers/Strand/Lay angle={math.radians(degrees):.10f}"
        held, turning = run(lay), run(lay, "Drive end/Free=rx")
        for name, reference, result in (("fixed", fixed, held), ("free", free, turning)):
            yield Check(f"EA/sum EA, {degrees} degrees, {name}, penetration {result.penetration:.4f} r", reference,
                        tangent(result, "end_force_x[N]") / (7 * math.pi), 1e-2)
        if degrees == 10:
            yield Check("torque over strain [N mm], 10 degrees", COUPLING, tangent(held, "end_moment_x[N.mm]"), 1e-2)
        three = run(lay, "Fibers/Strand/Outer fibers=3", "Contact/Largest penetration=1e-4")
        pull = 2 * tangent(three, "end_force_x[N]") - math.pi
        yield Check(f"EA/sum EA, {degrees} degrees, fixed, twice three wires, penetration {three.penetration:.5f} r", fixed,
                    pull / (7 * math.pi), 1e-2)
        if degrees == 10:
            yield Check("torque over strain [N mm], 10 degrees, twice three wires", COUPLING,
                        2 * tangent(three, "end_moment_x[N.mm]"), 1e-2)
