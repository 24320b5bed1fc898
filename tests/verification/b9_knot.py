# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""B9: a loose overhand knot, whose ends can spin, drawn tight with and without friction.

Reference: F R^2/B = 1/2 + mu sigma sqrt(R/h) for small h/R and mu, h the fiber's radius, R that of the loop,
sigma = .4923 (Audoly, Clauvelin, Neukirch, Phys. Rev. Lett. 99, 164301 (2007); Jawed et al., Phys. Rev. Lett. 115,
118302 (2015)). That is the beginning of an expansion in sqrt(h/R) and mu; parabolas in both lead there.
"""

import math

from check import Check

QUICK = False
SIGMA = .4923
YOUNG_MODULUS = 73000
ELEMENTS = {.0025: 270, .007: 160, .02: 95}  # for each h, about sqrt(h R) long
FRICTION = (.05, .1)
TAIL = 3.5


def knot(h):
    """The axis near its equilibrium, as functions of s; the loop has the radius 1 where it enters the braid.

    In the braid, the distance of its strands is a cubic polynomial between a contact in the middle and one at 3.75
    sqrt(h R) to either side. The loop is the elastica that closes the knot, to first order in the force in it; the
    tails fade out. One half of the fiber is the other one, turned by half a turn about y.
    """
    e = math.sqrt(h)
    contact, end = 3.75 * e, 4 * e
    y1, y3 = .549 * e, .505 / (22.5 * e)
    z0, z2, z3 = -1.01 * h, .1669, .3338 / (22.5 * e)

    # Places and slopes where the braid ends.
    beyond = (end - contact)**3, 3 * (end - contact)**2
    apart = (y1 * end - y3 * (end**3 - beyond[0]), y1 - y3 * (3 * end**2 - beyond[1]))
    aside = (z0 + z2 * end**2 - z3 * (end**3 - beyond[0]), 2 * z2 * end - z3 * (3 * end**2 - beyond[1]))
    slope = end / 2 - apart[1]
    start = math.pi - math.atan(slope)  # of the braid, along the loop from its far end
    force = (math.sin(start) - end) / (math.sin(start) + start / 2 + math.sin(2 * start) / 4)
    fade = 1 / math.sqrt(.5 + force)
    tilt = -(aside[0] + aside[1] * fade) / (end + fade)
    tail_y, tail_z = end / 2 + apart[1], tilt + aside[1]
    top = end**2 / 4 + apart[0] + fade * tail_y
    bottom = end**2 / 4 - apart[0] - (1 - force) * math.cos(start) - force / 2 * math.sin(start)**2
    loop_z, loop_slope = aside[0] - tilt * end, (tilt - aside[1]) * math.cos(math.pi - start)
    cubic = (loop_slope * start - loop_z) / (2 * start**3)

    u = f"abs({2 * (start + 2 * end + TAIL):.6f}*s - {start + 2 * end + TAIL:.6f})"
    v = f"({u} - {start + end:.6f})"
    kink = f"max(0, abs({v}) - {contact:.6f})^3"
    tail = f"exp(({end:.6f} - {v})/{fade:.6f})"
    side = "if(s < 0.5, -1, 1)"

    def pieces(loop, braid, tails):
        return f"if({u} < {start:.6f}, {loop}, if({u} < {start + 2 * end:.6f}, {braid}, {tails}))"

    x = f"{side}*if({u} < {start:.6f}, {force / 2:.6f}*({u} + sin({u})*cos({u})) - {1 - force:.6f}*sin({u}), {v})"
    y = pieces(f"{bottom - top:.6f} + {1 - force:.6f}*cos({u}) - {-force / 2:.6f}*sin({u})^2",
               f"{-top:.6f} + {v}^2/4 + {y1:.6f}*{v} - {y3:.6f}*({v}^3 - if({v} < 0, -1, 1)*{kink})",
               f"{-fade * tail_y:.6f}*{tail}")
    z = f"{side}*" + pieces(f"{loop_slope - 3 * cubic * start**2:.6f}*{u} + {cubic:.6f}*{u}^3",
                            f"{tilt:.6f}*{v} - {-z0:.6f} + {z2:.6f}*{v}^2 - {z3:.6f}*(abs({v})^3 - {kink})",
                            f"{-fade * tail_z:.6f}*{tail}")
    return "; ".join((x, y, z))


def loop_radius(row):
    """Of the circle through three points of the far half of the loop."""
    points = [[row[f"probe_0_at_{at}_{axis}[mm]"] for axis in "xyz"] for at in ("0.4", "0.5", "0.6")]
    a, b, c = (math.dist(points[i], points[i - 1]) for i in range(3))
    return a * b * c / math.sqrt((a + b + c) * (b + c - a) * (c + a - b) * (a + b - c))


def limit(points):
    """Where the parabola through three points is at 0."""
    return sum(y * math.prod(other / (other - x) for other, _ in points if other != x) for x, y in points)


def judge(run):
    penetration = 0
    forces, slopes = [], []
    for h, n in ELEMENTS.items():
        bending = YOUNG_MODULUS * math.pi / 4 * h**4
        force = {}
        for friction in (0,) + FRICTION:
            result = run(f"Fibers/Curves={knot(h)}", f"Fibers/Radius={h}", f"Fibers/Elements per fiber={n}",
                         f"Contact/Friction coefficient={friction}",
                         f"Drive start/Translation=-{1.5 * h}*t; 0; 0", f"Drive end/Translation={1.5 * h}*t; 0; 0")
            row = result.last
            radius = loop_radius(row)
            force[friction] = row["force_end[N]"] * radius**2 / bending
            penetration = max(penetration, result.penetration)
        root = math.sqrt(h / radius)
        slope = [(force[friction] - force[0]) / friction for friction in FRICTION]
        forces.append((root, force[0]))
        slopes.append((root, root * (slope[0] - FRICTION[0] * (slope[1] - slope[0]) / (FRICTION[1] - FRICTION[0]))))

    span = f"h/R from {forces[0][0]**2:.4f} to {forces[-1][0]**2:.4f}"
    yield Check(f"F R^2/B without friction, {span}, penetration {penetration:.4f} r", .5, limit(forces), .05)
    yield Check(f"sigma, {span}", SIGMA, limit(slopes), .1)
