# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""B8: strand of a core and six wires without friction, stiffness at zero strain over that of straight wires.

Reference: energy of helical rods on a core that does not give way, strand_energy.py. It knows no contact between the
wires, but six of the core's radius do not fit around it at an angle: they overlap, by 1.2 % of the diameter at 10
degrees, and here push each other outwards. So the strand is judged as two of three wires each, which do not touch; what
is the core's counts once. The ends are clamped, where wires do not lie as a helix does: the stiffness is that of the
further half of a strand of twice the length. At 5 degrees, where the overlap is small, all six are judged too.
"""

import math

from check import Check

QUICK = False
STRAIN, TWIST = 1e-3, 5e-4  # rad/mm
LENGTH, ELEMENTS = 50, 12
STRAIGHT = 7 * math.pi  # sum EA
CORE = (math.pi, 0, math.pi / 4)  # EA, coupling, GJ

# lay angle in degrees: ends that do not turn, ends free to turn
REFERENCE = {5: (.9902552, .9108858), 10: (.9615727, .7274858), 15: (.9155645, .5596589)}
COUPLING = 6.33701917  # N, at 10 degrees


def change(result, before, column):
    return result.at("t", 2)[column] - before[column]


def inverse(matrix):
    """Of a symmetric 2 x 2 matrix, given and returned as (11, 12, 22)."""
    a, b, c = matrix
    determinant = a * c - b * b
    return c / determinant, -b / determinant, a / determinant


def stiffness_of_pairs(run, lay, times):
    """Pull by strain, torque by strain and by twist of two strands of three wires on one core, and the penetration."""
    length = times * LENGTH
    settings = (lay, "Fibers/Strand/Outer fibers=3", f"Fibers/Strand/Length={length}",
                f"Fibers/Elements per fiber={times * ELEMENTS}", "Contact/Largest penetration=1e-5")
    drawn = run(*settings, f"Drive end/Translation={STRAIN * length}*max(0, t - 1); 0; 0")
    turned = run(*settings, "Drive end/Translation=0; 0; 0", f"Drive end/Rotation={TWIST * length}*max(0, t - 1); 0; 0")
    rest = drawn.at("t", 1)
    of_three = (change(drawn, rest, "end_force_x[N]") / STRAIN, change(drawn, rest, "end_moment_x[N.mm]") / STRAIN,
                change(turned, rest, "end_moment_x[N.mm]") / TWIST)
    return [2 * three - core for three, core in zip(of_three, CORE)], drawn.penetration


def judge(run):
    for degrees, (fixed, free) in REFERENCE.items():
        lay = f"Fibers/Strand/Lay angle={math.radians(degrees):.10f}"
        short, _ = stiffness_of_pairs(run, lay, 1)
        long, penetration = stiffness_of_pairs(run, lay, 2)
        further = [2 * b - a for a, b in zip(inverse(short), inverse(long))]  # compliances of lengths add up
        pull, coupling, torsion = inverse(further)
        what = f"{degrees} degrees, 3 + 3 wires, penetration {penetration:.1e} r"
        yield Check(f"EA/sum EA, fixed, {what}", fixed, pull / STRAIGHT, 1e-2)
        yield Check(f"EA/sum EA, free to turn, {what}", free, (pull - coupling ** 2 / torsion) / STRAIGHT, 1e-2)
        if degrees == 10:
            yield Check(f"torque over strain [N mm], {what}", COUPLING, coupling, 1e-2)
    for name, reference, settings in (("fixed", REFERENCE[5][0], ()), ("free to turn", REFERENCE[5][1], ("Drive end/Free=rx",))):
        result = run(f"Fibers/Strand/Lay angle={math.radians(5):.10f}", *settings)
        pull = change(result, result.at("t", 1), "end_force_x[N]") / STRAIN
        yield Check(f"EA/sum EA, {name}, 5 degrees, 6 wires, penetration {result.penetration:.4f} r", reference,
                    pull / STRAIGHT, 1e-2)
