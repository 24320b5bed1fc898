# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""The reactions of tow ends are in balance after every increment and add up to the loading curve."""

import sys
from itertools import groupby

from program_runs import SMALL_WEAVE, check, curve, finish, run

AXES = "xyz"
ENDS = [f"{family}_{tow}_{side}" for family in ("warp", "fill") for tow in (0, 1) for side in ("start", "end")]


def vector(row, name):
    return [row[name.replace("*", axis)] for axis in AXES]


def moment_about_origin(row):
    x, f = vector(row, "*[mm]"), vector(row, "force_*[N]")
    own = vector(row, "moment_*[N.mm]")
    return [own[i] + x[i - 2] * f[i - 1] - x[i - 1] * f[i - 2] for i in range(3)]


def imbalance(bodies, of):
    """Length of the sum of the vectors over the sum of their lengths."""
    vectors = [of(row) for row in bodies]
    total = [sum(v[i] for v in vectors) for i in range(3)]
    return sum(abs(c) for c in total) / sum(abs(c) for v in vectors for c in v)


def pull(bodies, family, axis):
    """Half of what the ends of a family pull outwards."""
    return .5 * sum((1 if row["body"].endswith("end") else -1) * row[f"force_{axis}[N]"]
                    for row in bodies if row["body"].startswith(family))


def main():
    done = run(SMALL_WEAVE, "pulled", "Solver/Contact tolerance=1e-5", "Biaxial/Strain ratio=0.5")
    check(f"status {done.returncode} {done.stderr}", done.returncode == 0)
    increments = [list(rows) for _, rows in groupby(curve("pulled", "reactions.csv"),
                                                    lambda row: (row["stage"], row["increment"]))]
    increments_of_curve = curve("pulled")
    check("rows for every increment of the curve",
          [(rows[0]["stage"], rows[0]["increment"], rows[0]["load"]) for rows in increments] ==
          [(row["stage"], row["increment"], row["load"]) for row in increments_of_curve])
    check("all tow ends and the ground", all([row["body"] for row in rows] == [*ENDS, "ground"]
                                             for rows in increments))
    for name, of in (("forces", lambda row: vector(row, "force_*[N]")), ("moments", moment_about_origin)):
        # Where a stage begins, others may have held the sample.
        worst = max(imbalance(rows, of) for rows in increments if rows[0]["increment"] > 0)
        check(f"{name} out of balance by {worst:.1e} of their sum", worst < 1e-3)
    # Ends slope with their tows: nothing turns them about the axis across while a fabric is woven.
    turning = {"weave": 0, "biaxial": 0}
    for rows in increments:
        largest = max(abs(c) for row in rows for c in vector(row, "moment_*[N.mm]"))
        for row in rows:
            if row["stage"] in turning and row["body"] in ENDS:
                across = row[f"moment_{'y' if row['body'].startswith('warp') else 'x'}[N.mm]"]
                turning[row["stage"]] = max(turning[row["stage"]], abs(across) / largest)
    check(f"moment across the tow while weaving {turning['weave']:.1e} of the largest", turning["weave"] < 1e-3)
    check(f"while pulling {turning['biaxial']:.1e}", turning["biaxial"] > 1e-2)
    compared = 0
    for row, bodies in zip(increments_of_curve, increments):
        for family, axis in (("warp", "x"), ("fill", "y")):
            if f"force_{family}[N]" in row:
                force = row[f"force_{family}[N]"]
                compared += 1
                found = pull(bodies, family, axis)
                if abs(found - force) > 1e-10 * abs(force):
                    check(f"load {row['load']}: {family} ends pull with {found}, curve {force}", False)
    check(f"pulls of the ends compared with the curve: {compared}",
          compared == 2 * sum(row["stage"] == "biaxial" for row in increments_of_curve) > 0)
    finish()


sys.exit(main())
