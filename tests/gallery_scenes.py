# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""The scenes of doc/gallery.md, with few fibers and elements and in long steps: each converges, with no crossing out of order,
and shows what the gallery says of it."""

import csv
import json
import os
import re
import resource

from program_runs import SOURCE, check, curve, finish, run

QUICK = ["Accuracy=draft", "Solver/Error estimate=false", "Output/Pictures=false", "Output/Slices=none", "Output/Fields every=0",
         "Output/Export="]
THIN = "Fabric/Warp/Fibers per tow=3"
PULL = [THIN, "Biaxial/First step=1", "Biaxial/Largest step=1"]

SCENES = {}  # settings and judge of each


def scene(path, *settings):
    def add(judge):
        SCENES[path] = settings, judge
        return judge
    return add


def at(rows, t):
    return next(row for row in rows if abs(row["t"] - t) < 1e-9)


@scene("prm/satin_weave.prm", *PULL, "Fabric/Warp/Fibers per tow=1")
@scene("prm/twill_weave.prm", *PULL, "Fabric/Warp/Fibers per tow=1")
@scene("prm/plain_weave.prm", *PULL, "Fabric/Warp/Tows=2")
def pulled(rows, directory):
    warp, fill = rows[-1]["force_warp[N]"], rows[-1]["force_fill[N]"]
    check(f"  forces {warp:.3g} N and {fill:.3g} N pull, and are alike", 0 < .7 * warp < fill < 1.4 * warp)


def stiffening(rows, force):
    """The secant at the end over that of the first increment."""
    return rows[-1][force] / rows[-1]["t"] / (rows[1][force] / rows[1]["t"])


@scene("prm/gallery/knit.prm", "Fibers/Elements per fiber=36", "Load/Largest step=0.5")
def knit(rows, directory):
    force, contacts = rows[-1]["force_right[N]"], rows[-1]["contact_force_sum[N]"]
    check(f"  loops catch: {force:.3g} N, contacts {contacts:.3g} N, {stiffening(rows, 'force_right[N]'):.3g} times as stiff",
          force > 0 and contacts > 0 and stiffening(rows, "force_right[N]") > 1.1)


@scene("prm/gallery/braid.prm", "Fibers/Elements per fiber=32", "Load/Largest step=0.25", "Contact/Largest penetration=0.02")
def braid(rows, directory):
    force = rows[-1]["force_end[N]"]
    check(f"  stiffer as fibers straighten: {force:.3g} N, {stiffening(rows, 'force_end[N]'):.3g} times as stiff",
          force > 0 and stiffening(rows, "force_end[N]") > 1.1)


@scene("prm/gallery/breaking_bundle.prm", "Load/Largest step=0.1")
def bundle(rows, directory):
    force, broken = ([row[name] for row in rows] for name in ("force_end[N]", "broken"))
    check(f"  holds {max(force):.3g} N at most, {force[-1]:.3g} N with {broken[-1]:g} broken", broken[-1] > 0 and force[-1] < max(force))


@scene("prm/gallery/rope.prm", "Fibers/Elements per fiber=8", "Load/End=1.25")
def rope(rows, directory):
    taut, end = at(rows, 1), rows[-1]
    check(f"  twisted by {end['end_moment_x[N.mm]']:.3g} N mm it is shorter by {taut['end_x[mm]'] - end['end_x[mm]']:.3g} mm",
          end["end_x[mm]"] < taut["end_x[mm]"] and end["end_moment_x[N.mm]"] > 0 and end["contact_force_sum[N]"] > 0)


@scene("prm/gallery/knot.prm", "Fibers/Elements per fiber=50", "Load/End=0.5", "Load/Largest step=0.1")
def knot(rows, directory):
    force, first = rows[-1]["force_end[N]"], rows[1]["force_end[N]"]
    check(f"  the smaller the loop, the larger the force: {first:.3g} N, then {force:.3g} N",
          force > 6 * first > 0 and rows[-1]["contact_force_sum[N]"] > 0)


@scene("prm/gallery/strand_bending.prm", "Fibers/Elements per fiber=8", "Contact/Largest penetration=0.02", "Load/End=15")
def strand(rows, directory):
    bent, straight = at(rows, 10)["end_moment_y[N.mm]"], rows[-1]["end_moment_y[N.mm]"]
    check(f"  friction holds {straight:.3g} N mm of {bent:.3g} N mm, the other way",
          bent > 0 > straight > -bent and rows[-1]["dissipation[N.mm]"] > 0)


@scene("prm/gallery/composite_shear.prm", THIN, "Shear/Largest angle=0.1", "Shear/First step=0.1")
def composite(rows, directory):
    force = rows[-1]["shear_force[N]"]
    check(f"  shear force {force:.3g} N", force > 0)


@scene("prm/gallery/cyclic_pull.prm", THIN, "Load/Largest step=0.5")
def cyclic(rows, directory):
    one, two, three = (at(rows, t)["force_warp[N]"] for t in (1, 2, 3))
    check(f"  {one:.3g} N, back to {two:.3g} N and again {three:.3g} N", 0 < two < .3 * one and abs(three / one - 1) < .05)
    first, again = at(rows, 1)["dissipation[N.mm]"], rows[-1]["dissipation[N.mm]"] - at(rows, 1)["dissipation[N.mm]"]
    check(f"  friction takes {first:.3g} N mm in the first pull and less in the cycle: {again:.3g} N mm", first > again >= 0)


@scene("prm/cells/plain_compaction.prm", "Compact/Fiber volume fraction=0.5", "Compact/First step=0.5", "Compact/Largest step=0.5")
def compaction(rows, directory):
    pressures = [row["pressure[MPa]"] for row in rows]
    check(f"  pressure rises to {pressures[-1]:.3g} MPa at {rows[-1]['fiber_volume_fraction']:.3g} of fiber",
          pressures == sorted(pressures) and pressures[-1] > 0 and abs(rows[-1]["fiber_volume_fraction"] - .5) < 1e-6)


@scene("prm/cells/plain_cell.prm", *PULL)
def cell(rows, directory):
    with open(os.path.join(directory, "stiffness.csv")) as file:
        warp, fill, shear = ([float(cell) for cell in row[1:]] for row in list(csv.reader(file))[1:])
    check(f"  stiffness {warp[0]:.3g} and {fill[1]:.3g} N/mm along tows, {shear[2]:.3g} N/mm in shear",
          min(warp[0], fill[1]) > 20 * shear[2] > 0)


def try_scene(path, settings, judge):
    directory = os.path.splitext(os.path.basename(path))[0]
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    done = run(os.path.join(SOURCE, path), directory, *QUICK, *settings)
    seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    check(f"{path}: {seconds:.1f} s, status {done.returncode} {done.stderr}", done.returncode == 0)
    if done.returncode != 0:
        return
    with open(os.path.join(directory, "summary.json")) as file:
        summary = json.load(file)
    out_of_order = sum(stage["crossings_out_of_order"] for stage in summary["stages"])
    check(f"  converged, {out_of_order} crossings out of order", summary["converged"] and out_of_order == 0)
    rows = [row for row in curve(directory) if row["stage"] == [stage["name"] for stage in summary["stages"]][-1]]
    judge(rows or curve(directory), directory)


with open(os.path.join(SOURCE, "doc", "gallery.md")) as gallery:
    named = set(re.findall(r"\./loom run (prm/[\w/]+\.prm)", gallery.read()))
check(f"scenes of the gallery that are not run here: {sorted(named - set(SCENES))}", named == set(SCENES))
for path, (settings, judge) in SCENES.items():
    try_scene(path, settings, judge)
finish()
