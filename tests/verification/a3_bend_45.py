# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""A3: 45 degree bend, an arc bent out of its plane by a dead force at its tip.

Reference: the beam of Simo and Reissner by shooting, for the square section of the classical
problem (Bathe and Bolourchi 1979) and for the round one of the scene. That has the same E I
and, with J = 2 I = 1/6 and nu = 0, the same G J; its E A and G A are 2.3 % larger.
"""

from check import Bound, Check, observed_order

QUICK = True

# load: tip x, y (radial), z
SQUARE = {300: (58.77912, 22.24478, 40.19189), 450: (52.23856, 18.50818, 48.50293), 600: (47.15044, 15.68480, 53.47486)}
ROUND = {300: (58.77914, 22.24479, 40.19181), 450: (52.23857, 18.50819, 48.50281), 600: (47.15046, 15.68481, 53.47472)}


def judge(run):
    for load in SQUARE:
        row = run().at("load", load / 600)
        for k, axis in enumerate("xyz"):
            for name, reference in (("square", SQUARE), ("round", ROUND)):
                yield Check(f"{axis}, load {load}, {name} section", reference[load][k], row[f"tip_{axis}[mm]"], 1e-3)
    tips = [run(f"Fibers/Elements per fiber={n}").last["tip_x[mm]"] for n in (4, 8, 16)]
    yield Bound("observed order of x, 4, 8, 16 elements", observed_order(*tips), least=2)
