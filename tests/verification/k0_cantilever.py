# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""K0: a glass cantilever of 62.5 diameters under a dead force of 10 E I/L^2 at its tip.

Reference: the beams of Kirchhoff and of Timoshenko (shear factor 0.9), by shooting.
"""

from check import Check, Report

QUICK = True
LENGTH = 1.

# u_z/L and u_x/L
REFERENCE = {"Kirchhoff": (.810737, -.554977), "Timoshenko": (.810824, -.555027)}


def judge(run):
    result = run()
    yield Report("CPU seconds", result.cpu_seconds, "Chrono .028, DisMech .70, Yade 2.2")
    tip = result.last
    for beam, (deflection, shortening) in REFERENCE.items():
        yield Check(f"u_z/L, {beam}", deflection, tip["tip_z[mm]"] / LENGTH, 1e-3)
        yield Check(f"u_x/L, {beam}", shortening, tip["tip_x[mm]"] / LENGTH - 1, 1e-3)
    # The best of the other programs, Chrono, is off by 0.007 %.
    finer = run("Fibers/Elements per fiber=16")
    yield Check("u_z/L, Timoshenko, 16 elements", REFERENCE["Timoshenko"][0], finer.last["tip_z[mm]"] / LENGTH, 7e-5)
