# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""The rows of the sweep. Each is a function of `run` whose docstring says what it turns and on
what scene. It yields, for each value, that value and a function that runs it and returns the
result and its checks, and may end with checks of the whole row, whose result is None.
"""

import math

import thick_rod
from b2_angles import closed_form, force
from b4_crossing_beams import PUSH
from b5_capstan import RING, growth, tensions
from check import Bound, Check
from d1_patch import AREA, RADIUS, STRETCH, YOUNG
from k1_crossed import FORCE


class Row:
    """Results of the values that reached their end, for checks of the whole row."""

    def __init__(self):
        self.results, self.errors = [], []

    def add(self, result, *checks):
        self.results.append(result)
        self.errors.append(abs(checks[0].error()) if hasattr(checks[0], "reference") else None)
        return result, checks

    def iterations(self):
        counts = [result.newton_iterations for result in self.results]
        return None, [Bound("most over fewest Newton iterations", max(counts) / min(counts), most=2)]

    def falling(self, tolerance):
        """Errors within the tolerance count as equal."""
        large = [max(error, tolerance) for error in self.errors]
        rises = max((b / a for a, b in zip(large, large[1:])), default=1)
        return None, [Bound("largest error over the one before", rises, most=1)]


class Shown(Check):
    """Judged beside others, as its error has to fall."""

    def good(self):
        return True

    def shown_tolerance(self):
        return ""


def crossing_force(run, angle, *settings):
    """Result and force of case B2."""
    results = []

    def keep(line):
        results.append(run(line, *settings, scene="b2_angles"))
        return results[-1]

    found = force(keep, angle)
    return results[-1], found


def contrast(run):
    """Stiffness contrast E_f/E_m: case D1, fibers and matrix stretched together."""
    row = Row()

    def judge(ratio):
        matrix = YOUNG / ratio
        result = run(f"Matrix/Young modulus={matrix:.12g}", scene="d1_patch")
        exact = (matrix * AREA + 4 * YOUNG * math.pi * RADIUS ** 2) * STRETCH * (STRETCH ** 2 - 1) / 2
        return row.add(result, Check("force [N]", exact, result.last["force_right[N]"], 1e-8))

    for ratio in (1, 1e2, 1e4, 1e6):
        yield f"{ratio:g}", lambda ratio=ratio: judge(ratio)
    yield "all", row.iterations


def slenderness(run):
    """Slenderness L/D: case A2 with eight elements, nu = 0; thick rods against thick_rod.py."""
    radius, inertia = .008, math.pi / 4 * .008**4

    def judge(slender, load):
        length = 2 * radius * slender
        result = run(f"Fibers/Polylines=0 0 0, {length:.10g} 0 0", "Fibers/Poisson ratio=0",
                     f"Drive tip/Force=0; 0; {load * 73000 * inertia / length**2:.12g}*t",
                     scene="a2_elastica")
        x, z = thick_rod.tip(load, radius / length)
        return result, [Check(f"w/L at PL^2/EI = {load}", z, result.last["tip_z[mm]"] / length, 1e-3),
                        Check(f"u/L at PL^2/EI = {load}", 1 - x, 1 - result.last["tip_x[mm]"] / length, 1e-3)]

    # Thicker rods have no equilibrium at 10: the law of the section softens.
    for slender, load in ((5, 1), (10, 1), (20, 10), (50, 10), (100, 10), (1000, 10), (10000, 10)):
        yield f"{slender}", lambda slender=slender, load=load: judge(slender, load)


def element_length(run):
    """Element length over r: case A2 at L = 1000 r and PL^2/EI = 10."""
    for ratio in (1, 3.125, 10, 31.25, 100):
        def judge(ratio=ratio):
            result = run(f"Fibers/Elements per fiber={1000 / ratio:.0f}", scene="a2_elastica")
            x, z = thick_rod.tip(10, 1e-3)
            return result, [Check("w/L", z, result.last["tip_z[mm]"] / 8, 1e-3),
                            Check("u/L", 1 - x, 1 - result.last["tip_x[mm]"] / 8, 1e-3)]
        yield f"{ratio:g}", judge


def penalty(run):
    """Penalty over pi E/4: a fiber pressed on another by a line load, and case K1."""
    pressed, crossed = Row(), Row()
    ratios = (1e-2, 1e-1, 1, 1e1, 1e2, 1e3)

    def judge_pressed(ratio):
        stiffness = ratio * math.pi / 4 * 73000
        result = run(f"Contact/Line stiffness={stiffness:.10g}", scene="f4_pressed_pair")
        return pressed.add(result, Check("penetration over q/k", 1, result.penetration * .01 * stiffness / .01, .02))

    def judge_crossed(ratio):
        result = run(f"Contact/Line stiffness={ratio * math.pi / 4 * 73000:.10g}", scene="k1_crossed")
        return crossed.add(result, Bound("crossing force over that without penetration",
                                         result.last["force_upper[N]"] / FORCE, most=1.01))

    for ratio in ratios:
        yield f"{ratio:g}, pressed", lambda ratio=ratio: judge_pressed(ratio)
    yield "all pressed", pressed.iterations
    for ratio in ratios:
        yield f"{ratio:g}, crossed", lambda ratio=ratio: judge_crossed(ratio)
    yield "all crossed", crossed.iterations


def capstan(angle):
    """Settings of case B5 with less than half a turn around the cylinder."""
    length = 6 * angle + 12
    turn, tail = f"({length / 6:.9g}*(s - 0.5))", f"({length:.9g}*abs(s - 0.5) - {3 * angle:.9g})"
    on, sine, cosine = f"abs(s - 0.5) < {3 * angle / length:.9g}", math.sin(angle / 2), math.cos(angle / 2)
    x = f"if({on}, 6*cos{turn}, {6 * cosine:.9g} - {sine:.9g}*{tail})"
    z = f"if({on}, 0 - 6*sin{turn}, if(s < 0.5, 1, 0 - 1)*({6 * sine:.9g} + {cosine:.9g}*{tail}))"
    held, drawn = "1.592612e-3*min(50*t, 1)", "0.03*max(t - 0.02, 0)"
    return (f"Fibers/Curves={x}; 0; {z} | {RING}", "Drive held/Held=x y z spin", "Drive held/Free=x z",
            f"Drive held/Force=-{sine:.9g}*{held}; 0; {cosine:.9g}*{held}", "Drive drawn/Held=x y z spin",
            f"Drive drawn/Translation=-{sine:.9g}*{drawn}; 0; -{cosine:.9g}*{drawn}")


def friction(run):
    """Friction coefficient: case B5 around half a turn; beyond 1 around pi/mu, for the same tensions. Friction acts
    on the fiber's surface, and its couple about the axis counts: Euler's formula is 13 % higher at 5."""
    def judge(mu):
        angle = math.pi / max(1, mu)
        result = run(f"Contact/Friction coefficient={mu}", *(capstan(angle) if mu > 1 else ()), scene="b5_capstan")
        if mu > 1:
            pulls = (math.hypot(result.last[f"{end}_force_x[N]"], result.last[f"{end}_force_z[N]"])
                     for end in ("drawn", "held"))
            ratio = next(pulls) / next(pulls)
        else:
            ratio = tensions(result.last)
        loss = [0] + [row["dissipation[N.mm]"] for row in result.rows]
        return result, [Check("T1/T0", math.exp(growth(mu) * angle), ratio, .02),
                        Bound("least dissipation of an increment [N mm]",
                              min(b - a for a, b in zip(loss, loss[1:])), least=0)]

    for mu in (0, .1, .5, 1, 2, 5):
        yield f"{mu:g}", lambda mu=mu: judge(mu)


def crossing_angle(run):
    """Crossing angle [degrees]: case B2."""
    def judge(angle):
        result, found = crossing_force(run, angle)
        return result, [Check("force/k [mm^2]", closed_form(angle), found, 2e-2)]

    for angle in (90, 45, 10, 1, .1, 0):
        yield f"{angle:g}", lambda angle=angle: judge(angle)


def overlap(run):
    """Initial overlap over D: crossed fibers of case K1 that start in each other and are left alone."""
    for part in (0, .25, .5, .75, 1):
        def judge(part=part):
            z = .016 * (1 - part)
            result = run(f"Fibers/Polylines=-0.5 0 0, 0.5 0 0; 0 -0.5 {z:.6g}, 0 0.5 {z:.6g}", "Load/Probes=all at 0.5",
                         "Drive upper/Translation=0; 0; 0", scene="k1_crossed")
            apart = [(row["probe_1_at_0.5_z[mm]"] - row["probe_0_at_0.5_z[mm]"]) / .016 for row in result.increments]
            # Which one is above when axes coincide is open, but not that it stays there.
            apart = [a * math.copysign(1, apart[0]) if part == 1 else a for a in apart]
            farthest = max(apart, key=lambda a: abs(a - 1))
            return result, [Check("distance of axes over D, farthest off", 1, farthest, .02)]
        yield f"{part:g}", judge
    for part in (.5, 1):
        def judge(part=part):
            z = .02 * (1 - part)
            result = run(f"Fibers/Polylines=0 0 0, 1 0 0; 0 0 {z:.6g}, 1 0 {z:.6g}", "Load/Probes=1 at 0.5",
                         scene="f4_pressed_pair")
            return result, [Check("distance of axes over D", 1, result.last["probe_1_at_0.5_z[mm]"] / .02, .02)]
        yield f"{part:g}, parallel", judge

    def weave():
        result = run("Fabric/Warp/Fibers per tow=1", "Stages=weave, relax", scene="../../tests/scenes/small_weave")
        wrong = max(stage["crossings_out_of_order"] for stage in result.summary["stages"])
        return result, [Bound("crossings out of order", wrong, most=0)]
    yield "1, woven", weave


def exact_place(run):
    """A contact exactly at a node or a fiber's end: case B4, elements 0.25 long, stiff contact."""
    inertia = math.pi * .01 ** 4 / 4
    usual = []

    def judge(settings, compliance):
        result = run("Contact/Line stiffness=0", *settings, scene="b4_crossing_beams")
        exact = (PUSH - .01 * result.penetration) / (compliance / inertia)
        usual.append(result.newton_iterations)
        cuts = sum(stage["rejected_increments"] for stage in result.summary["stages"])
        return result, [Check("force [N]", exact, result.last["contact_force_sum[N]"], .01),
                        Bound("Newton iterations over those within an element", usual[-1] / usual[0], most=2),
                        Bound("rejected increments", cuts, most=0)]

    upper = 1.5**3 / (48 * 30000)
    for name, place in (("within an element", .0625), ("at a node", 0), ("at a middle node", .125),
                        ("at a fiber's end", 1)):
        line = f"{place - 1} 0 0, {place + 1} 0 0; 0 -0.75 0.02, 0 0.75 0.02"
        compliance = upper + (1 - place**2) ** 2 / (6 * 70000)
        yield name, lambda line=line, compliance=compliance: judge([f"Fibers/Polylines={line}"], compliance)
    # The upper fiber is a cantilever whose tip lies on the lower one.
    cantilever = ("Fibers/Polylines=-1 0 0, 1 0 0; 0 0 0.02, 0 1.6 0.02", "Drive upper_pin/Ends=1 end",
                  "Drive upper_roll/Ends=1 at 0.875", "Drive upper_roll/Held=x z tilt")
    yield "at a free tip", lambda: judge(cantilever, 2 ** 3 / (48 * 70000) + 1.4**3 / (3 * 30000))


def increments(run):
    """One increment against 100: case K1, the upper fiber also moves along the lower one; a tight
    contact tolerance, so that paths are compared and not what it leaves."""
    def judge(mu, allowed):
        ends = [run(f"Load/Largest step={step}", "Load/First step=1", f"Contact/Friction coefficient={mu}",
                    "Drive upper/Translation=0.02*t; 0; -0.06*t", "Solver/Contact tolerance=1e-5", scene="k1_crossed")
                for step in (1, .01)]
        one, many = (end.last for end in ends)
        return ends[0], [Check(f"{name} [N] in one against 100 increments", many[key], one[key], allowed)
                         for name, key in (("press", "upper_force_z[N]"), ("drag", "upper_force_x[N]"))]

    for mu, allowed in ((0, 1e-3), (.3, .01)):
        yield f"mu = {mu:g}", lambda mu=mu, allowed=allowed: judge(mu, allowed)


def mesh(run):
    """Elements per fiber: case K1, against 32 elements; errors below 0.01 % count as equal, since the
    force does not vary by more from 8 to 32 elements, and not evenly. Contact elements per D: case B2 at one degree."""
    row, spaced = Row(), Row()

    def pressed(n):
        return run(f"Fibers/Elements per fiber={n}", scene="k1_crossed")

    def judge_elements(n):
        result = pressed(n)
        return row.add(result, Shown("force [N]", pressed(32).last["force_upper[N]"], result.last["force_upper[N]"], 0))

    def judge_stations(per_diameter):
        result, found = crossing_force(run, 1, f"Contact/Stations per element={5 * per_diameter:g}")
        return spaced.add(result, Shown("force/k [mm^2]", closed_form(1), found, 0))

    for n in (1, 2, 4, 8, 16):
        yield f"{n} elements", lambda n=n: judge_elements(n)
    yield "all elements", lambda: row.falling(1e-4)
    for n in (.25, .5, 1, 2, 4):
        yield f"{n:g} a diameter", lambda n=n: judge_stations(n)
    yield "all stations", lambda: spaced.falling(.02)


ROWS = {"contrast": contrast, "slenderness": slenderness, "element length": element_length, "penalty": penalty,
        "friction": friction, "angle": crossing_angle, "overlap": overlap, "place": exact_place,
        "increments": increments, "mesh": mesh}
QUICK = ("slenderness", "penalty", "overlap", "place")
