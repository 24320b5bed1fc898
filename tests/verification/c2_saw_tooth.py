# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""C2: crimp interchange of saw-tooth yarns (Kawabata), balanced and unbalanced, under biaxial and uniaxial strain.

Reference: equilibrium of four bars at an incompressible crossing, by a root search, with the axial force of a Saint
Venant-Kirchhoff section, N = EA lambda (lambda^2 - 1)/2; the published numbers are those of linear bars.
"""

from check import Check

QUICK = False
TOLERANCE = .05

BALANCED = ()
UNBALANCED = ("Fibers/Polylines=-0.5 0 -0.048, 0 0 0.002, 0.5 0 -0.048; 0 -0.5 0.148, 0 0 -0.002, 0 0.5 0.148",
              "Fibers/Young modulus=159154.943, 79577.4715")

# yarns, strains along x and y: pulls over EA as published, then with the program's law, likewise the height of the
# crossing over the ends of the yarn along x
REFERENCE = (("balanced", BALANCED, .02, .02, (.018879, .018879), (.019427, .019427), None),
             ("balanced", BALANCED, .02, 0, (.012336, .008099), (.012549, .008228), (.08021, .08015)),
             ("balanced", BALANCED, .05, 0, (.036743, .016108), (.038685, .016767), None),
             ("unbalanced", UNBALANCED, .02, .02, (.041167, .015390), (.042410, .015814), None),
             ("unbalanced", UNBALANCED, .02, 0, (.034883, .007546), (.035768, .007706), None))


def drawn(warp, fill):
    """Settings that draw the ends of the cell out by these strains."""
    return (f"Drive warp_start/Translation=-{warp / 2}*t; 0; 0", f"Drive warp/Translation={warp / 2}*t; 0; 0",
            f"Drive fill_start/Translation=0; -{fill / 2}*t; 0", f"Drive fill/Translation=0; {fill / 2}*t; 0")


def judge(run):
    for name, yarns, warp, fill, published, forces, height in REFERENCE:
        result = run(*yarns, *drawn(warp, fill))
        row = result.last
        what = f"{name}, strains {warp}, {fill}, penetration {result.penetration:.3f} r"
        yield Check(f"F1/EA, {what}", forces[0], row["warp_force_x[N]"], TOLERANCE, published=published[0])
        yield Check(f"F2/EA, {what}", forces[1], row["fill_force_y[N]"], TOLERANCE, published=published[1])
        if height:
            yield Check(f"h1, {what}", height[1], row["probe_0_at_0.5_z[mm]"] - row["warp_z[mm]"], TOLERANCE,
                        published=height[0])
