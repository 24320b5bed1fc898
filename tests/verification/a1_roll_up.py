# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""A1: a cantilever of 50 diameters rolled up to a full circle by an end moment.

Reference: the circle of Euler and Bernoulli, corrected for the law of Saint Venant and
Kirchhoff. The energy of doc/theory.md 1.3 for uniform bending by kappa without axial force,
minimised over the lengths of axis and section vectors up to (r kappa)^4, gives
M = E I kappa (1 - (11/8 - nu) (r kappa)^2) and an axis shortened by (3/8 - nu/4) (r kappa)^2.
"""

import math

from check import Check

QUICK = True
LENGTH, RADIUS, YOUNG = .8, .008, 73000
MOMENT = 1.844431e-3  # at t = 1


def curvature(moment, nu):
    """Per stress-free length."""
    straight = moment / (YOUNG * math.pi * RADIUS**4 / 4)
    kappa = straight
    for _ in range(50):
        kappa = straight / (1 - (11 / 8 - nu) * (RADIUS * kappa)**2)
    return kappa


def judge(run):
    for nu in (0, .2, .3, .4):
        result = run(f"Fibers/Poisson ratio={nu}")
        for t, name in ((.25, "quarter"), (.5, "half"), (1, "full")):
            row = result.at("t", t)
            kappa = curvature(t * MOMENT, nu)
            stretch = 1 - (3 / 8 - nu / 4) * (RADIUS * kappa)**2
            angle = kappa * LENGTH
            u = 1 - stretch * math.sin(angle) / angle
            w = stretch * (1 - math.cos(angle)) / angle
            yield Check(f"tip angle [rad], {name} circle, nu = {nu}", angle, -row["tip_ry[rad]"], 2e-3)
            yield Check(f"u/L, {name} circle, nu = {nu}", u, 1 - row["tip_x[mm]"] / LENGTH, 2e-3)
            yield Check(f"w/L, {name} circle, nu = {nu}", w, row["tip_z[mm]"] / LENGTH, 2e-3,
                        absolute=t == 1)  # where it is next to nothing
