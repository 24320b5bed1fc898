# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""Scenes by which no setting was chosen, run with an error asked for in per cent."""

from documents import markdown_table
from scenes import CONTACT, ELEMENTS, PENETRATION, STATIONS, error

ASKED = (10, 2, .5)

# scene: columns of its loading curve, compared with those of the finest run
SCENES = {
    "a1_roll_up": ("tip_x[mm]", "tip_z[mm]"),
    "a2_elastica": ("tip_x[mm]", "tip_z[mm]"),
    "a4_weighted_cantilever": ("tip_z[mm]",),
    "a5_helical": ("tip_z[mm]",),
    "b4_crossing_beams": ("contact_force_sum[N]",),
    "b10_pull_out": ("force_puller[N]", "dissipation[N.mm]"),
    "c1_crossing": ("lower_force_x[N]", "upper_force_y[N]"),
    "c2_saw_tooth": ("warp_force_x[N]", "fill_force_y[N]"),
    "k1_crossed": ("force_upper[N]", "lower_end_force_x[N]"),
    "k2_bundle_7": ("twist_force_x[N]", "twist_moment_x[N.mm]"),
}
FINEST = {ELEMENTS: 64, STATIONS: 4, PENETRATION: .0025, CONTACT: 1e-5}


def curve(result, columns):
    return [[row["load"]] + [row[column] for column in columns] for row in result.rows]


def found_error(run, name, result):
    """The largest of a result's numbers."""
    columns = SCENES[name]
    return error(curve(result, columns), curve(run(f"verification/{name}", FINEST), columns))


def judge(run, percent):
    rows, met = [], {asked: 0 for asked in ASKED}
    for name, columns in SCENES.items():
        cells = [name, ", ".join(columns)]
        for asked in ASKED:
            result = run(f"verification/{name}", [f"Accuracy={asked:g} %", f"{ELEMENTS}=0"])
            found = found_error(run, name, result)
            met[asked] += found <= asked / 100
            cells.append(f"{percent(found)}{'' if found <= asked / 100 else ' (missed)'}, {result.cpu_seconds:.2f} s")
        print(" | ".join(cells), flush=True)
        rows.append(cells)
    rows.append(["met", ""] + [f"{met[asked]} of {len(SCENES)}" for asked in ASKED])
    print(" | ".join(rows[-1]), flush=True)
    return markdown_table(["scene", "numbers"] + [f"asked {asked:g} %" for asked in ASKED], rows)
