# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""The scenes of the study: what is measured on each, against what, and which knobs are turned."""

import math

from a3_bend_45 import ROUND
from b1_rope import ENDS, FORCE, TORQUE, torque
from k3_plain_weave_4x4 import TENSION, tension

ELEMENTS = "Fibers/Elements per fiber"
TOW_ELEMENTS = "Fabric/Warp/Elements per fiber"
STATIONS = "Contact/Stations per element"
PENETRATION = "Contact/Largest penetration"
SLIP = "Contact/Elastic slip"
CONTACT = "Solver/Contact tolerance"
NEWTON = "Solver/Newton tolerance"
WEAVING = "Weaving/Step"
PRECISION = "Solver/Linear solver"
CELLS = "Matrix/Cells along x and Matrix/Cells along y"  # turned as one
THROUGH = "Matrix/Cells through thickness"
DEGREE = "Matrix/Degree"
ESTIMATE = "Solver/Error estimate"  # of which a finest run would need one eight times finer
SHORT = {PRECISION: "Factor precision", CELLS: "Cells along x and y"}  # others by their last word
FACTORS = ("double factor", "single factor")
FINEST_FABRIC = {TOW_ELEMENTS: 48, STATIONS: 4, PENETRATION: .005, CONTACT: 1e-5}
LEVELS = {"draft": .10, "standard": .02, "fine": .005}


class Scene:
    """Numbers of a scene, as rows of a load and values, beside those they should be."""

    def __init__(self, file, about, curve, knobs, base, exact=None, finest=None, grid=(), levels=(), held=None,
                 repeats=({},)):
        self.file, self.about, self.curve, self.knobs, self.base = file, about, curve, knobs, base
        self.exact = exact      # rows in closed form
        self.finest = finest    # or the settings of the run that counts as converged
        self.grid = grid        # settings that are turned together
        self.levels = levels    # settings beside Accuracy for the three levels; None: these are not for it
        self.held = held        # rows in closed form that levels are held to beside the finest run
        self.repeats = repeats  # settings that should not matter: the reference is the mean over them


def error(rows, reference):
    """The largest in any value, over the largest of that value in the reference."""
    scales = [max(abs(row[k]) for row in reference) for k in range(len(reference[0]))]
    return max(abs(value - exact) / scale
               for row in reference
               for value, exact, scale in zip(at(rows, row[0]), row[1:], scales[1:]))


def at(rows, load):
    """Values at a load, by straight lines between rows; before the first one, from 0."""
    if rows[0][0] > 0:
        rows = [[0] * len(rows[0])] + rows
    for before, after in zip(rows, rows[1:]):
        if load <= after[0] * (1 + 1e-9):
            part = (load - before[0]) / (after[0] - before[0])
            return [a + part * (b - a) for a, b in zip(before[1:], after[1:])]
    raise ValueError(f"no row at load {load}")


def mean(curves):
    """Of the values of several runs, at the loads of the first one."""
    return [[row[0]] + [sum(values) / len(curves) for values in zip(*(at(rows, row[0]) for rows in curves))]
            for row in curves[0]]


def tip(result):
    start = (100 / math.sqrt(2), 100 - 100 / math.sqrt(2), 0)
    return [[row["load"]] + [row[f"tip_{axis}[mm]"] - x for axis, x in zip("xyz", start)] for row in result.rows]


def exact_tip():
    start = (100 / math.sqrt(2), 100 - 100 / math.sqrt(2), 0)
    return [[load / 600] + [end - x for end, x in zip(point, start)] for load, point in ROUND.items()]


def rope(result):
    return [[1, sum(result.last[f"{end}_force_z[N]"] for end in ENDS), torque(result.last)]]


def yarn(result):
    return [[1, tension(result)]]


def pull(result):
    return [[row["load"], row["force_warp[N]"], row["force_fill[N]"]]
            for row in result.rows if row["stage"] == "biaxial"]


SCENES = {
    "a3": Scene(
        "verification/a3_bend_45",
        "Case A3, an arc bent out of its plane. Error: that of the displacement of the tip at three loads, against "
        "the closed form. There is no contact.",
        tip,
        {ELEMENTS: (2, 3, 4, 8, 16, 32, 64),
         NEWTON: (.1, 1e-2, 1e-3, 1e-5, 1e-8, 1e-11),
         PRECISION: FACTORS},
        {ELEMENTS: 16},
        exact=exact_tip(), levels=(f"{ELEMENTS}=0",)),
    "b1": Scene(
        "verification/b1_rope",
        "Case B1, two beams twisted into a rope. Error: the larger of those of rope force and torque, against the "
        "closed form. The stiffness of contact is given and part of it; there is no friction.",
        rope,
        {ELEMENTS: (4, 6, 8, 12, 16, 24, 32, 48),
         STATIONS: (.5, 1, 2, 4, 8),
         CONTACT: (.1, .01, 1e-3, 1e-4, 1e-5),
         PRECISION: FACTORS},
        {ELEMENTS: 16, STATIONS: 2, CONTACT: 1e-4},
        exact=[[1, FORCE, TORQUE]],
        levels=(f"{ELEMENTS}=0",)),
    "k3": Scene(
        "verification/k3_plain_weave_4x4",
        "Case K3, 4 × 4 woven fibers drawn out by 1 %. Error: that of the force in the yarns, against the finest run. "
        "There is no friction, and each crossing has one station.",
        yarn,
        {ELEMENTS: (8, 12, 16, 20, 24, 32, 48),
         STATIONS: (1, 2, 4),
         PENETRATION: (.08, .04, .02, .01, .005, .0025),
         CONTACT: (.1, .01, 1e-3, 1e-4, 1e-5),
         PRECISION: FACTORS},
        {ELEMENTS: 16, STATIONS: 2, PENETRATION: .02, CONTACT: 1e-4},
        finest={ELEMENTS: 64, STATIONS: 4, PENETRATION: .00125, CONTACT: 1e-6},
        grid=((ELEMENTS, (8, 16, 24, 32)), (PENETRATION, (.02, .01, .005))),
        held=[[1, TENSION]]),
    "demo": Scene(
        "plain_weave",
        "`prm/plain_weave.prm`, woven and pulled to 2 % both ways with friction. Error: the largest in the curves of "
        "both forces over the largest force, against the mean of the finest runs of two fabrics, woven with steps of "
        "0.4 and 0.5.",
        pull,
        {TOW_ELEMENTS: (16, 24, 32),
         STATIONS: (1, 2, 4),
         PENETRATION: (.04, .02, .01),
         SLIP: (.1, .05, .025),
         CONTACT: (1e-2, 1e-3, 1e-4, 1e-5),
         "Biaxial/Largest step": (.2, .1)},
        {TOW_ELEMENTS: 24, STATIONS: 2, PENETRATION: .02, CONTACT: 1e-4, SLIP: .05, WEAVING: .5,
         "Biaxial/Largest step": .2},
        finest=FINEST_FABRIC,
        repeats=tuple({WEAVING: step} for step in (.5, .4))),
    "composite": Scene(
        "plain_composite_biaxial",
        "`prm/plain_composite_biaxial.prm`, a frictionless plain weave between two layers of matrix, pulled to 1 % "
        "both ways. Error: the largest in the curves of both forces over the largest force, against the run with the "
        "finest matrix; fibers and contact are the same in all.",
        pull,
        {CELLS: (2, 8, 16),
         THROUGH: (1, 2, 4),
         DEGREE: (1, 2)},
        {CELLS: 8, THROUGH: 1, DEGREE: 2},
        finest={CELLS: 24, THROUGH: 4, ESTIMATE: "false"},
        grid=((CELLS, (8, 16)), (THROUGH, (1, 2)), (DEGREE, (1, 2))), levels=None),
}
