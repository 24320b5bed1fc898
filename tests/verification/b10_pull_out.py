# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""B10: a fiber drawn out of n crossings that press from both sides with N: 2 n mu N.

Reference: closed form. Coulomb's law with a reversible slip e loses 4 mu N (u - e) at a
contact in a cycle from -u to u. The law rises as 2 s - s^2 over s = slip / e, so that
mu N / k_t = e for the secant stiffness at which a contact begins to slip. By then the
fiber has stretched between its drawn end and the contacts, which is not their slip.
"""

import math

from check import Bound, Check

QUICK = True
CROSSINGS, FRICTION, PRESSURE = 3, .2, 3e-4
ELASTIC_SLIP = .05 * .01
HALF_CYCLE = .005 / 2
STIFFNESS = 73000 * math.pi * .01 ** 2
TO_FIRST, BETWEEN = .4, .2
LIMIT = 2 * CROSSINGS * FRICTION * PRESSURE


def judge(run):
    result = run()
    rows = result.rows
    time = [row["t"] for row in rows]
    force = [row["force_puller[N]"] for row in rows]
    place = [row["puller_x[mm]"] for row in rows]
    loss = [row["dissipation[N.mm]"] for row in rows]

    sliding = [f for t, f in zip(time, force) if 1.99 < t < 3.01]
    yield Check(f"force [N] after two elastic slips, penetration {result.penetration:.2g} r", LIMIT, sliding[0], .02)
    yield Check("force [N] over three elements, farthest off", LIMIT, max(sliding, key=lambda f: abs(f - LIMIT)), .02)

    # Half an elastic slip, where the law is 3/4 of its limit.
    drawn = result.at("t", 1.25)["force_puller[N]"]
    shares = [1 - k / CROSSINGS for k in range(1, CROSSINGS)]
    lengths = [TO_FIRST + BETWEEN * sum(shares[:k]) for k in range(CROSSINGS)]
    stretch = drawn / STIFFNESS * sum(lengths) / CROSSINGS
    stick = (.5 * ELASTIC_SLIP - stretch) / (1 - math.sqrt(1 - drawn / LIMIT))
    yield Check("stick displacement [mm]", ELASTIC_SLIP, stick, .02)

    begin, end = (min(range(len(rows)), key=lambda i: abs(time[i] - t)) for t in (3, 5))
    area = sum(.5 * (force[i] + force[i + 1]) * (place[i + 1] - place[i]) for i in range(begin, end))
    yield Check("hysteresis area of a cycle [N mm]", 4 * LIMIT * (HALF_CYCLE - ELASTIC_SLIP), area, .02)
    yield Check("dissipation of a cycle [N mm]", 4 * LIMIT * (HALF_CYCLE - ELASTIC_SLIP), loss[end] - loss[begin], .02)
    yield Bound("least dissipation of an increment [N mm]", min(b - a for a, b in zip([0] + loss, loss)), least=0)
