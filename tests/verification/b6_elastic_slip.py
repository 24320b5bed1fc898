# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""B6: cantilever of two fibers that slip on each other elastically, E = r = 1, L = 100.

Reference: composite beam with a tangential spring k_t per length between its parts.
Friction is no such spring: its stiffness is that of a pressure f, and it bends. At the
start of its law it is 2 mu f / slip; the pressure comes from an overlap held by clips.
"""

from check import Bound, Check

QUICK = True
LENGTH, FORCE, OVERLAP, ELASTIC_SLIP = 100., 4e-8, .01, .05
BENDING = 3.141592653589793 / 4  # E I of a fiber

# k_t [N/mm^2]: deflection over that without friction
REFERENCE = {1e-6: .98994365, 1e-5: .90976499, 1e-4: .55456132, 1e-3: .26203457}


def judge(run):
    sliding = run("Contact/Friction coefficient=0").last["tip_z[mm]"]
    yield Check("deflection without friction", FORCE * LENGTH**3 / (6 * BENDING), sliding, .02)
    for stiffness, ratio in REFERENCE.items():
        line_stiffness = stiffness * ELASTIC_SLIP / (2 * OVERLAP)
        result = run(f"Contact/Line stiffness={line_stiffness!r}")
        yield Check(f"w/w_slip at k_t = {stiffness:g}, penetration {result.penetration:.2g} r", ratio,
                    result.last["tip_z[mm]"] / sliding, .02)
        yield Bound(f"dissipation at k_t = {stiffness:g} [N mm]", result.last["dissipation[N.mm]"], least=0, most=0)
