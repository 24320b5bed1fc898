# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""What runs say of their own error at the end of the curve, beside the error that they have."""

import os
import re

import unseen
from documents import markdown_table
from scenes import CONTACT, ELEMENTS, FINEST_FABRIC, NEWTON, PENETRATION, SCENES, STATIONS, pull

NEGLIGIBLE = 1e-3  # below it no factor counts: both are far below what is asked for
FACTOR = 3
FINEST = {ELEMENTS: 64, STATIONS: 4, PENETRATION: .0025, CONTACT: 1e-6}


def columns(*names):
    """The curve of some columns."""
    return lambda result: [[row["load"]] + [row[name] for name in names] for row in result.rows]


def fabric(*settings):
    """A weave of the demo with settings of its own, and its finest run."""
    return "plain_weave", list(settings), pull, FINEST_FABRIC


# scene: file, settings, curve, settings of the finest run
CASES = {
    "a3": ("verification/a3_bend_45", [f"{ELEMENTS}=0"], SCENES["a3"].curve, {ELEMENTS: 64}),
    "b1": ("verification/b1_rope", [f"{ELEMENTS}=0"], SCENES["b1"].curve, {ELEMENTS: 48, CONTACT: 1e-6}),
    "k3": ("verification/k3_plain_weave_4x4", [], SCENES["k3"].curve, FINEST),
    **{name: (f"verification/{name}", [f"{ELEMENTS}=0"], columns(*names), FINEST) for name, names in unseen.SCENES.items()},
    "end moment": ("../tests/scenes/end_moment", [], columns("tip_x[mm]", "tip_y[mm]", "tip_rz[rad]"),
                   {ELEMENTS: 128, NEWTON: 1e-11}),
    "belt": ("verification/b5_capstan", ["Accuracy=standard", "Fibers/Stress free=straight"], columns("force_drawn[N]"),
             {ELEMENTS: 240, PENETRATION: .0025, CONTACT: 1e-6}),
    "demo": fabric(),
    "twill 3/1": fabric("Fabric/Pattern=twill 3/1"),
    "friction 0.8": fabric("Contact/Friction coefficient=0.8"),
    "composite": ("plain_composite_biaxial", [], pull, SCENES["composite"].finest),
}


def worst(result):
    """By how much which column is off, as the run says of the largest of its errors."""
    with open(os.path.join(result.directory, "log.txt")) as log:
        found = re.findall(r"estimated error of the loading curve .* %, (\S+) in (\S+): mesh", log.read())
    return (float(found[-1][0]), found[-1][1]) if found else (0, "")


def judge(run, percent):
    rows, within, given = [], 0, 0
    for name, (file, settings, curve, finest) in CASES.items():
        result = run(file, settings)
        reference = run(file, settings + [f"{entry}={value}" for key, value in finest.items()
                                          for entry in key.split(" and ")] + ["Solver/Error estimate=false"])
        rows_of = [[row[1:] for row in curve(one)] for one in (result, reference)]
        found = max(abs(a - b) / max(abs(row[k]) for row in rows_of[1])
                    for k, (a, b) in enumerate(zip(rows_of[0][-1], rows_of[1][-1])))
        parts = result.summary["stages"][-1]["estimated_error"]
        said = parts["total"]
        amount, column = worst(result)
        if amount > 0:
            off = abs(result.rows[-1][column] - reference.rows[-1][column])
            found = max(found, off / amount * said)
        good = said is not None and (max(said, found) < NEGLIGIBLE or found / FACTOR <= said <= FACTOR * found)
        within += good
        given += said is not None
        rows.append([name, column, *("" if parts[part] is None else percent(parts[part])
                             for part in ("mesh", "stations", "penetration", "matrix", "tolerance", "total")),
                     percent(found), "none is given" if said is None else "yes" if good else "no"])
        print(" | ".join(rows[-1]), flush=True)
    rows.append([f"{within} of {given}"] + [""] * 9)
    return markdown_table(["scene", "largest in", "mesh", "stations", "penetration", "matrix", "tolerance", "total", "error", "within a factor of 3"],
                          rows)
