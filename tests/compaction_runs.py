# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""Compaction of a cell: there and back, by pressure, on two ranks, restarted; stacks of plies; the power law's script;
and shear of a cell, there and back."""

import json
import os
import shutil
import subprocess
import sys

from program_runs import SCENES, SOURCE, check, check_same, command, curve, finish, interrupt, n_rows, run

CELL = os.path.join(SCENES, "small_cell.prm")
STEPS = ["Compact/First step=0.25", "Compact/Largest step=0.25"]
BACK = ["Stages=compact", "Compact/Thickness=0.0315", "Compact/Return=true",
        *STEPS,
        "Contact/Line stiffness=50000"]  # not stiffened on the way
PRESSED = ["Compact/Pressure=2", *STEPS]
STACK = ["Fabric/Plies=2"]


def weave(directory, *settings):
    done = run(CELL, directory, "Stages=weave, relax", *settings)
    check(f"{directory}: status {done.returncode} {done.stderr}", done.returncode == 0)
    return os.path.join(directory, "checkpoint")


def begin(directory, woven, *settings, ranks=1):
    """From the woven state, in an empty directory."""
    shutil.rmtree(directory, ignore_errors=True)
    return run(CELL, directory, *settings, ranks=ranks, restart=woven)


def check_return(woven):
    for ranks in (1, 2):
        done = begin(f"back_{ranks}", woven, *BACK, ranks=ranks)
        check(f"there and back on {ranks} ranks: status {done.returncode}", done.returncode == 0)
    check_same("  curve", "back_1", "back_2", 1e-4)
    rows = curve("back_1")
    check(f"  from rest four increments there and four back, {len(rows)} rows", len(rows) == 9)
    there, back = rows[1:5], rows[5:]
    pairs = list(zip(back[:3], there[2::-1]))  # the way back ends at a thickness that the other has no row of
    check("  thickness comes back",
          len(pairs) == 3 and all(abs(up["thickness[mm]"] - down["thickness[mm]"]) < 1e-9 for up, down in pairs))
    check("  no work is gained on the way back",
          len(pairs) == 3 and all(up["pressure[MPa]"] < 1.001 * down["pressure[MPa]"] for up, down in pairs))
    slippery = begin("slippery", woven, *BACK, "Compact/Friction coefficient=0")
    check(f"plates without friction: status {slippery.returncode}", slippery.returncode == 0)
    check("  press less", curve("slippery")[4]["pressure[MPa]"] < there[-1]["pressure[MPa]"])


def check_shear(woven):
    rough = ["Stages=shear", "Shear/Largest angle=0.3", "Shear/First step=0.1", "Shear/Largest step=0.1"]
    for ranks in (1, 2):
        done = begin(f"shear_{ranks}", woven, *rough, ranks=ranks)
        check(f"shear on {ranks} ranks: status {done.returncode} {done.stderr}", done.returncode == 0)
    check_same("  curve", "shear_1", "shear_2", 1e-4)
    done = begin("smooth", woven, "Stages=shear", "Contact/Friction coefficient=0", "Shear/Largest angle=0.3",
                 "Shear/First step=0.03", "Shear/Largest step=0.03", "Shear/Way=1, 0")
    check(f"there and back without friction: status {done.returncode} {done.stderr}", done.returncode == 0)
    rows = curve("smooth")
    first, last, turned = rows[1], rows[-1], max(rows, key=lambda row: row["shear_angle[rad]"])
    for period in ("period_warp[mm]", "period_fill[mm]"):
        check(f"  {period} stays", all(abs(row[period] / first[period] - 1) < 1e-9 for row in rows))
    # On the way there tows that friction does not hold any more slide between two places, by jumps that no work accounts for.
    stored, work = (turned[energy] - last[energy] for energy in ("elastic_energy[N.mm]", "work[N.mm]"))
    check(f"  work {work:.4g} is stored, {stored:.4g}", abs(work / stored - 1) < .03)
    check("  and given back", abs(last["shear_moment[N.mm]"]) < 1e-4 * turned["shear_moment[N.mm]"])


def check_restart(woven):
    shutil.rmtree("stopped", ignore_errors=True)
    stopped = interrupt(command(CELL, "stopped", *BACK, restart=woven), "stopped", "stop", 5)
    check(f"stopped on the way back: status {stopped} after {n_rows('stopped')} rows",
          stopped == 3 and 5 <= n_rows("stopped") < n_rows("back_1"))
    again = run(CELL, "stopped", *BACK, restart=os.path.join("stopped", "checkpoint"))
    check(f"  restarted: status {again.returncode} {again.stderr}", again.returncode == 0)
    check_same("  curve", "back_1", "stopped", 1e-10)


def press(directory, woven, *settings):
    done = begin(directory, woven, "Stages=compact", *PRESSED, *settings)
    check(f"{directory}: status {done.returncode} {done.stderr}", done.returncode == 0)
    last = curve(directory)[-1]
    check(f"  pressure {last['pressure[MPa]']:.6f} MPa is met", abs(last["pressure[MPa]"] - 2) < 2e-3)
    return last["thickness[mm]"]


def measures(directory):
    with open(os.path.join(directory, "summary.json")) as file:
        return json.load(file)["fabric"]


def check_stacks(woven):
    alone = press("one_ply", woven)
    straight = press("straight", weave("woven_straight", *STACK), *STACK)
    shift = [*STACK, "Fabric/Ply shift=0.25, 0.25"]
    shifted = press("shifted", weave("woven_shifted", *shift), *shift)
    check(f"  one ply {alone:.4f} mm, two {straight:.4f} mm, shifted {shifted:.4f} mm: plies nest",
          shifted < straight < 2.2 * alone)
    one, two = measures("one_ply"), measures("straight")
    check("  the weight is that of two", abs(two["areal_weight[kg/m2]"] / one["areal_weight[kg/m2]"] - 2) < 1e-3)
    turned = subprocess.run([*command(CELL, "shown", *STACK, "Fabric/Ply rotation=0, 1"), "--check"],
                            capture_output=True, text=True)
    check("  --check says how many", turned.returncode == 0 and "plies           2\n" in turned.stdout)


def check_refusals():
    for settings, words in ((["Fabric/Plies=2", "Fabric/Periodic=false"], "Plies"),
                            (["Fabric/Plies=2", "Fabric/Ply rotation=0, 1", "Fabric/Fill/Tow spacing=0.3",
                              "Fabric/Fill/Same as warp=true"], "no square"),
                            (["Fabric/Plies=3", "Fabric/Ply rotation=0, 1"], "one for each ply"),
                            (["Fabric/Plies=2", "Fabric/Ply shift=0.5"], "two for each ply"),
                            (["Stages=weave, relax, coat, compact", "Matrix/Layers=filled", "Compact/Thickness=.03"],
                             "compact before coat"),
                            (["Stages=weave, relax, shear, coat", "Matrix/Layers=filled"], "coat before shear"),
                            (["Stages=weave, relax, coat", "Matrix/Layers=filled", "Matrix/Size along x=.3"], "of its own size")):
        done = run(CELL, "refused", *settings)
        lines = done.stderr.strip().splitlines()
        check(f"refused: {done.stderr.strip()}", done.returncode == 1 and len(lines) == 1 and words in lines[0])
        check("  nothing is written", not os.path.exists("refused"))


def check_power_law():
    os.makedirs("law", exist_ok=True)
    with open(os.path.join("law", "loading_curve.csv"), "w") as file:
        file.write("stage,fiber_volume_fraction,pressure[MPa]\n")
        for fraction in (.3, .4, .45, .5, .55, .5):
            file.write(f"compact,{fraction},{100 * fraction ** 9}\n")
    done = subprocess.run([sys.executable, os.path.join(SOURCE, "tools", "power_law.py"), "law", "--least", "0"],
                          capture_output=True, text=True)
    check(f"power law: {done.stdout.strip()}", done.stdout.startswith("n = 9.00 +- 0.00, a = 100 MPa, spread 0.0 %, 5"))


def main():
    woven = weave("woven")
    check_return(woven)
    check_restart(woven)
    check_shear(woven)
    check_stacks(woven)
    check_refusals()
    check_power_law()
    finish()


sys.exit(main())
