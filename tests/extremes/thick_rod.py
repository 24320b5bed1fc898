# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""A thick cantilever under a dead force across its tip, by shooting.

The elastica of case A2 neither stretches nor shears, and its section stays as it is. This rod's
round section follows the Saint Venant-Kirchhoff law with nu = 0; it stays plane, can shear and
swells in the plane of bending. With the stretch e, shear g and curvature k of
r' = e t + g n in the section's axes t and n, and the section's swelling s, strains are

    E33 = ((e - y s k)^2 + g^2 - 1) / 2 = a - b y + c y^2,  2 E3n = s g,  Enn = (s^2 - 1) / 2.

Units: E I = 1 and length 1.
"""

import math

STEPS = 200


def strains(normal, shear, moment, radius):
    """e, g and k that belong to the forces of a section, by fixed point."""
    area, fourth = 4 / radius**2, radius**2 / 2  # E A, and E times the integral of y^4
    a, e, g, s, bend = 0., 1., 0., 1., moment  # bend = s k
    for _ in range(200):
        before = bend
        c = bend**2 / 2
        bend = moment / (s * (a + e * e + c * fourth))
        c = bend**2 / 2
        a = (normal / e - 3 * c) / area
        g = shear / (a * area + c + area * s * s / 2)
        e = math.sqrt(1 + 2 * a - g * g)
        s = math.sqrt(1 - 2 * bend * moment / (s * s * area) - g * g)
        if abs(bend - before) < 1e-13 * (1 + abs(bend)):
            return e, g, bend / s
    raise ArithmeticError("the section has no equilibrium: it is bent too sharply")


def slope(force, radius, turn, moment):
    """Derivatives of the section's turn, of the moment and of the place x, z."""
    sine, cosine = math.sin(turn), math.cos(turn)
    e, g, k = strains(force * sine, force * cosine, moment, radius)
    x = e * cosine - g * sine
    return k, -force * x, x, e * sine + g * cosine


def shoot(force, radius, moment):
    """Turn, moment and place of the tip, from the moment at the clamp, by Runge and Kutta."""
    state, h = [0., moment, 0., 0.], 1 / STEPS
    for _ in range(STEPS):
        k1 = slope(force, radius, *state[:2])
        k2 = slope(force, radius, *(y + h / 2 * d for y, d in zip(state[:2], k1)))
        k3 = slope(force, radius, *(y + h / 2 * d for y, d in zip(state[:2], k2)))
        k4 = slope(force, radius, *(y + h * d for y, d in zip(state[:2], k3)))
        state = [y + h / 6 * (p + 2 * q + 2 * r + t) for y, p, q, r, t in zip(state, k1, k2, k3, k4)]
    return state


def tip(force, radius):
    """x and z of the tip, where the moment there is none: secants."""
    one, other = .4 * force, .5 * force
    rest = shoot(force, radius, one)[1]
    for _ in range(50):
        end = shoot(force, radius, other)
        if abs(end[1]) < 1e-11 * force:
            return end[2], end[3]
        one, other, rest = other, other - end[1] * (other - one) / (end[1] - rest), end[1]
    raise ArithmeticError("no equilibrium was found")
