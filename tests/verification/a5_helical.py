# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""A5: helical beam, wound up by an end moment and drawn out of its plane by a dead force.

Reference: the beam of Simo and Reissner by shooting, with E I = G J = 100 and E A = G A = 1e4
(Ibrahimbegovic 1997), and with the section of the scene. A round fiber with that E A has a
radius of L/50, bent until r kappa = 0.25, far from a beam with constant E I; so the fiber
is thinner, E A = 4e6 and G A = 2e6, for which the published numbers, of E A = G A = 1e4,
were computed anew in the same way; it is seen where the curves are tight.
"""

from check import Check

QUICK = False

# load factor: tip z
GIVEN = {.01: 1.56314, .035: 3.27495, .05: 2.75074, .1: -1.09173, .2: -.59850}
THIN = {.01: 1.562641, .035: 3.273212, .05: 2.748248, .1: -1.096705, .2: -.6084479}


def judge(run):
    for factor in GIVEN:
        z = run().at("t", 200 * factor)["tip_z[mm]"]
        yield Check(f"tip z [mm], load factor {factor}", THIN[factor], z, 1e-2, published=GIVEN[factor])
