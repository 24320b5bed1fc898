# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""B5: capstan, tensions of a fiber that slides around half of a rigid cylinder.

Reference: Euler's exp(mu pi), where bending plays no part. With bending stiffness, what
bends freely at both ends are elasticas that leave the cylinder before the half turn is
done, where it presses with a point force (transcendental equation of the three parts).
Friction acts on the fiber's surface and not on its axis, which growth() has and Euler does
not: 1 % of the ratio at mu = 1.
"""

import math

from check import Bound, Check

QUICK = False
IDEAL = {.1: 1.369108, .3: 2.566332, .5: 4.810477, 1: 23.1407}
BENT = {.01: 2.558141, .1: 2.491763}  # E I / (T0 rho^2): T1 / T0 at mu = 0.3
RHO, BENDING = 6, 73000 * math.pi / 4 * .01**4
RING = "5.49*cos(1.2*pi*(s - 0.5)); 0; 0 - 5.49*sin(1.2*pi*(s - 0.5))"


def growth(mu):
    """Of the tension per radian, which is mu for a string, where the axis runs on a circle and r/rho = 1/600.

    Friction q = mu p acts on the lever r. The curvature stays, and so does the moment: the shear force
    is -q r. With p = T/rho - mu r p' and T' = mu p (1 - r/rho), T = exp(x theta) has
    x (1 + mu x r/rho) = mu (1 - r/rho).
    """
    lever = .01 / RHO
    return 2 * mu * (1 - lever) / (1 + math.sqrt(1 + 4 * mu**2 * lever * (1 - lever)))


def judge(run):
    for friction, ratio in IDEAL.items():
        result = run(f"Contact/Friction coefficient={friction}")
        yield Check(f"T1/T0 at mu = {friction}, penetration {result.penetration:.2g} r", ratio, tensions(result.last), .02)
        if friction == .3:
            yield from dissipation(result, ratio)
    for stiffness, ratio in BENT.items():
        force = BENDING / (stiffness * RHO**2)
        result = run("Fibers/Stress free=straight", f"Fibers/Curves={bent_around(stiffness)} | {RING}",
                     f"Drive held/Force=-{force:.7g}*min(50*t, 1); 0; 0")
        yield Check(f"T1/T0 with E I = {stiffness} T0 rho^2, penetration {result.penetration:.2g} r", ratio,
                    tensions(result.last), .02)


def tensions(row):
    return row["drawn_force_x[N]"] / row["held_force_x[N]"]


def dissipation(result, ratio):
    """Over the second half of the way, where all of the fiber slides."""
    first, last = result.at("t", .5), result.last
    way = first["drawn_x[mm]"] - last["drawn_x[mm]"]
    loss = [0] + [row["dissipation[N.mm]"] for row in result.rows]
    yield Check("dissipation [N mm] while it slides", -last["held_force_x[N]"] * (ratio - 1) * way,
                last["dissipation[N.mm]"] - first["dissipation[N.mm]"], .02)
    yield Bound("least dissipation of an increment [N mm]", min(b - a for a, b in zip(loss, loss[1:])), least=0)


def bent_around(stiffness):
    """The fiber under T0 at both ends without friction, as functions of s.

    In a tail the axis is inclined to the pull by a with sin(a/2) = 1/cosh(w), where w is
    the length over sqrt(E I / T0), and a curvature of 1/rho begins the arc.
    """
    length = math.sqrt(stiffness) * RHO
    lift_off = 2 * math.asin(length / (2 * RHO))
    start = math.acosh(2 * RHO / length)
    arc = RHO * (math.pi / 2 - lift_off)
    far_x = RHO * math.sin(lift_off) + arc - 2 * length * math.tanh(start)
    far_z = RHO + length**2 / (2 * RHO)

    along = f"{2 * (arc + 6 * length):.9g}*abs(s - 0.5)"  # from the middle
    w = f"({start:.9g} + ({along} - {arc:.9g})/{length:.9g})"
    x = f"if({along} < {arc:.9g}, {RHO}*cos({along}/{RHO}), {far_x:.9g} - {along} + {2 * length:.9g}*tanh{w})"
    z = f"if({along} < {arc:.9g}, {RHO}*sin({along}/{RHO}), {far_z:.9g} - {2 * length:.9g}/cosh{w})"
    return f"{x}; 0; if(s < 0.5, 1, 0 - 1)*{z}"
