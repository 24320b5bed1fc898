# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""A2: elastica, a cantilever of 500 diameters under a dead force at its tip.

Reference: Mattiasson, Int. J. Numer. Meth. Engng 17 (1981) 145-153; recomputed by shooting.
"""

from check import Bound, Check, observed_order

QUICK = True
LENGTH = 8.

# P L^2 / E I: tip deflection and shortening over L
REFERENCE = {1: (.30172077, .05643324), 2: (.49345748, .16064172), 5: (.71379152, .38762836), 10: (.81060902, .5549956)}


def tip(run, load, elements):
    row = run(f"Fibers/Elements per fiber={elements}").at("load", load / 10)
    return row["tip_z[mm]"] / LENGTH, 1 - row["tip_x[mm]"] / LENGTH


def judge(run):
    for load, (deflection, shortening) in REFERENCE.items():
        w, u = tip(run, load, 8)
        yield Check(f"w/L at PL^2/EI = {load}", deflection, w, 1e-3)
        yield Check(f"u/L at PL^2/EI = {load}", shortening, u, 1e-3)
    yield Bound("observed order, 4, 8, 16 elements", observed_order(*(tip(run, 10, n)[0] for n in (4, 8, 16))), least=2)
