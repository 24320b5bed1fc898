# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""B5: capstan, tensions of a fiber that slides around half of a rigid cylinder.

Reference: T1 / T0 = exp(mu pi); with bending stiffness, tails that are elasticas
(`Stress free = straight`). The fiber is 1/250 of the cylinder, as friction acts on its
surface and not on its axis.
"""

from check import Bound, Check

QUICK = False
IDEAL = {.1: 1.369108, .3: 2.566332, .5: 4.810477, 1: 23.1407}


def judge(run):
    for friction, ratio in IDEAL.items():
        result = run(f"Contact/Friction coefficient={friction}")
        tension = [row["drawn_force_x[N]"] / row["held_force_x[N]"] for row in result.rows]
        loss = [0] + [row["dissipation[N.mm]"] for row in result.rows]
        yield Check(f"T1/T0 at mu = {friction}, penetration {result.penetration:.2g} r", ratio, tension[-1], .02)
        yield Bound(f"least dissipation of an increment at mu = {friction} [N mm]",
                    min(b - a for a, b in zip(loss, loss[1:])), least=0)
    # E I / (T0 rho^2) = 0.01
    result = run("Contact/Friction coefficient=0.3", "Fibers/Stress free=straight")
    yield Check(f"T1/T0 at mu = 0.3 with bending, penetration {result.penetration:.2g} r", 2.558141,
                result.last["drawn_force_x[N]"] / result.last["held_force_x[N]"], .02)
