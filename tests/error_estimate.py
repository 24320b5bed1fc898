# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""The estimated error of the loading curve against the true one, from a run that is much finer in that respect.

    error_estimate.py PROGRAM SOURCE_DIRECTORY
"""

import json
import math
import os
import sys

from program_runs import SMALL_WEAVE, SOURCE, check, curve, finish, run, unit

FACTOR = 3  # that estimates may be off by

BEND, ROPE, WEAVE, CROSSED, CANTILEVER, ROLL_UP = (os.path.join(SOURCE, "prm", "verification", name + ".prm")
                                          for name in ("a3_bend_45", "b1_rope", "k3_plain_weave_4x4", "k1_crossed",
                                                       "a2_elastica", "a1_roll_up"))
# The ends that one body holds are so far apart [mm].
LEVER = {WEAVE: .6}
# Where places are at the start; other columns begin at zero.
BEGUN = {"tip_x[mm]": 100 * math.sin(math.pi / 4), "tip_y[mm]": 100 - 100 * math.cos(math.pi / 4)}

TIGHT = ["Solver/Contact tolerance=1e-5"]
FABRIC = ["Fabric/Warp/Elements per fiber=12", "Contact/Stations per element=1"]
# Twice as many stations change less than the tolerance leaves.
SPARSE = ["Fabric/Warp/Elements per fiber=12", "Contact/Stations per element=0.5"]
FINE_WEAVE = ["Fibers/Elements per fiber=64", "Contact/Stations per element=1", "Contact/Largest penetration=0.00125"]

SLENDER = ["Fibers/Polylines=0 0 0, 160 0 0", "Fibers/Poisson ratio=0", "Drive tip/Force=0; 0; 9.17345e-8*t"]

FILLED = ["Stages=weave, relax, coat, biaxial", "Fabric/Warp/Elements per fiber=12", "Contact/Stations per element=1",
          "Matrix/Layers=filled", "Matrix/Cells along x=4", "Matrix/Cells along y=4", "Matrix/Degree=1",
          "Matrix/Young modulus=2000", "Matrix/Junction spacing=0.02"]

# scene, settings, part of the estimate, settings of the run to compare with
CASES = [
    ("bend_8_elements", BEND, [], "mesh", ["Fibers/Elements per fiber=64"]),
    ("bend_4_elements", BEND, ["Fibers/Elements per fiber=4"], "mesh", ["Fibers/Elements per fiber=64"]),
    ("rope", ROPE, [], "total", ["Fibers/Elements per fiber=48"]),
    ("weave", WEAVE, [], "mesh", ["Fibers/Elements per fiber=64"]),
    ("weave", WEAVE, [], "penetration", ["Contact/Largest penetration=0.00125"]),
    ("weave", WEAVE, [], "total", FINE_WEAVE),
    ("weave_4_percent", WEAVE, ["Contact/Largest penetration=0.04"], "penetration", ["Contact/Largest penetration=0.00125"]),
    ("weave_8_elements", WEAVE, ["Fibers/Elements per fiber=8"], "mesh", ["Fibers/Elements per fiber=64"]),
    ("weave_8_elements", WEAVE, ["Fibers/Elements per fiber=8"], "total", FINE_WEAVE),
    ("fabric", SMALL_WEAVE, FABRIC, "mesh", ["Fabric/Warp/Elements per fiber=36", "Contact/Stations per element=0.34"]),
    # with the shape in which it was woven and relaxed
    ("fabric_soft", SMALL_WEAVE, FABRIC + ["Contact/Largest penetration=0.06"], "penetration",
     ["Contact/Largest penetration=0.004"]),
    ("fabric_sparse", SMALL_WEAVE, SPARSE, "stations", ["Contact/Stations per element=4"]),
    ("filled", SMALL_WEAVE, FILLED, "matrix", ["Matrix/Cells along x=16", "Matrix/Cells along y=16",
                                               "Matrix/Cells through thickness=4"]),
]
QUIET = ["Output/Pictures=false", "Output/Slices=none", "Output/Fields every=0"]


def final(name, scene, *settings, **options):
    """Last row of the curve and its estimate."""
    process = run(scene, name, *TIGHT, *QUIET, *settings, **options)
    check(f"{name}: status {process.returncode} {process.stderr}", process.returncode == 0)
    with open(os.path.join(name, "summary.json")) as file:
        return curve(name)[-1], json.load(file)["stages"][-1]["estimated_error"]


def change(row, other, lever=0):
    """Largest over the columns, over the largest value of that unit; moments over no less than a force times a lever."""
    scale = {}
    # what a weave stores is no error of the test after it
    columns = [name for name in row if "[" in name and name != "elastic_energy[N.mm]"]
    for name in columns:
        scale[unit(name)] = max(scale.get(unit(name), 0), abs(row[name] - BEGUN.get(name, 0)))
    scale["[N.mm]"] = max(scale.get("[N.mm]", 0), lever * scale.get("[N]", 0))
    return max(abs(row[name] - other[name]) / scale[unit(name)] for name in columns if scale[unit(name)] > 0)


def main():
    done = {}
    for name, scene, settings, part, finer in CASES:
        if name not in done:
            done[name] = final(name, scene, *settings)
        row, estimate = done[name]
        reference, _ = final(f"{name}_{part}_reference", scene, *settings, *finer, "Solver/Error estimate=false")
        true, found = change(row, reference, LEVER.get(scene, 0)), estimate[part]
        check(f"{name}: error by {part} {true:.2e}, estimate {found}",
              found is not None and true / FACTOR < found < true * FACTOR)
    _, alone = final("alone", WEAVE)
    _, shared = final("shared", WEAVE, ranks=2)
    check(f"two ranks: {shared}, one: {alone}",
          all(shared[part] is alone[part] is None or abs(shared[part] - alone[part]) <= 1e-3 * alone[part] + 1e-8
              for part in alone))
    row, estimate = final("slender", CANTILEVER, *SLENDER)
    finer, _ = final("slender_reference", CANTILEVER, *SLENDER, "Fibers/Elements per fiber=16")
    true = max(abs(row[name] - finer[name]) for name in ("tip_x[mm]", "tip_z[mm]")) / row["tip_z[mm]"]
    check(f"slender: error by mesh {true:.2e}, estimate {estimate['mesh']}",
          true / FACTOR < estimate["mesh"] < true * FACTOR)
    # its forces are rounding: only lengths, angles and moments have an error
    row, estimate = final("moment", ROLL_UP)
    finer, _ = final("moment_reference", ROLL_UP, "Fibers/Elements per fiber=64", "Solver/Error estimate=false")
    true = 4 / 3 * abs(row["tip_x[mm]"] - finer["tip_x[mm]"]) / abs(row["tip_x[mm]"] - .8)
    check(f"moment: error by mesh {true:.2e}, estimate {estimate['mesh']}",
          true / FACTOR < estimate["mesh"] < true * FACTOR)
    for elements in (1, 16):
        name = f"crossed_{elements}"
        _, estimate = final(name, CROSSED, f"Fibers/Elements per fiber={elements}")
        with open(os.path.join(name, "log.txt")) as file:
            said = 'relied on; a larger "Elements per fiber"' in file.read()
        check(f"{name}: estimate {estimate['total']}, said to be too large: {said}",
              said == (estimate["total"] > .1) == (elements == 1))
    _, off = final("off", WEAVE, "Solver/Error estimate=false")
    check("not asked for: none", all(value is None for value in off.values()))
    finish()


sys.exit(main())
