# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""A small fabric in a matrix: coated without moving, sheared, bent and pulled; restarts, ranks, what a dry scene lacks, refusals."""

import json
import math
import os
import shutil
import subprocess
import sys
import time

from program_runs import SMALL_WEAVE, SOURCE, check, check_same, command, curve, finish, run

MATRIX = ["Matrix/Layers=both", "Matrix/Cells along x=3", "Matrix/Cells along y=3"]
SHEAR = ["Stages=weave, relax, coat, shear", "Shear/Largest angle=0.15", "Shear/Largest step=0.05"]
LENGTH = .48  # of the sample [mm]
CURVE_ONLY = "Solver/Error estimate=false"


def model(directory):
    with open(os.path.join(directory, "summary.json")) as file:
        summary = json.load(file)
    return {**summary["model"], "estimate": summary["stages"][-1]["estimated_error"]}


def check_run(what, directory, *settings, **options):
    done = run(SMALL_WEAVE, directory, *settings, **options)
    check(f"{what}: status {done.returncode} {done.stderr}", done.returncode == 0)


def n_rows(directory):
    file = os.path.join(directory, "loading_curve.csv")
    return len(curve(directory)) if os.path.exists(file) else 0


def check_restart(straight, first, *settings, **options):
    """After each of the increments of the straight run, from row `first` on, that can be caught."""
    shutil.rmtree("stopped", ignore_errors=True)
    settings += (CURVE_ONLY,)
    arguments, n_stops = command(SMALL_WEAVE, "stopped", *settings, **options), 0
    for rows in range(first, n_rows(straight)):
        process = subprocess.Popen(arguments, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while n_rows("stopped") < rows and process.poll() is None:
            time.sleep(.005)
        open(os.path.join("stopped", "stop"), "w").close()
        n_stops += process.wait() == 3
        arguments = command(SMALL_WEAVE, "stopped", *settings, restart=os.path.join("stopped", "checkpoint"))
    check(f"stopped {n_stops} times before the end, with {n_rows('stopped')} rows", n_stops > 0)
    process = subprocess.run(arguments, capture_output=True)
    check(f"  taken to the end: status {process.returncode}", process.returncode == 0)
    check_same("  curve of the straight run", straight, "stopped", 1e-10)


def check_refusal(what, words, *settings, scene=SMALL_WEAVE, **options):
    shutil.rmtree("refused", ignore_errors=True)
    done = run(scene, "refused", *settings, **options)
    lines = done.stderr.splitlines()
    check(f"{what}: status {done.returncode}, {lines}",
          done.returncode == 1 and len(lines) == 1 and all(word in lines[0] for word in words))
    check("  nothing written", not os.path.exists("refused"))


def main():
    check_run("sheared", "sheared_1", *MATRIX, *SHEAR)
    coat = next(row for row in curve("sheared_1") if row["stage"] == "coat")
    check(f"coating loads no junction: {coat['largest_junction_force[N]']}", coat["largest_junction_force[N]"] < 1e-10)
    sizes = model("sheared_1")
    nodes = 2 * 7 * 7 * 3
    check(f"{sizes['matrix_dofs']} dofs of matrix, {sizes['junctions']} junctions",
          sizes["matrix_dofs"] == 3 * nodes and sizes["junctions"] == coat["junctions"])
    check(f"estimated error {sizes['estimate']}", all(0 < (sizes["estimate"][part] or 0) < .2 for part in ("matrix", "total")))
    for name in ("matrix.pvd", "junctions.pvd"):
        check(f"{name} written", os.path.exists(os.path.join("sheared_1", name)))

    check_run("sheared on 2 ranks", "sheared_2", *MATRIX, *SHEAR, ranks=2)
    check_same("  curve", "sheared_1", "sheared_2", 1e-4)
    shared = model("sheared_2")["estimate"]
    check(f"  estimated error {shared}", abs(shared["matrix"] / sizes["estimate"]["matrix"] - 1) < 1e-2)
    check_restart("sheared_1", 3, *MATRIX, *SHEAR)

    checkpoint = os.path.join("coated", "checkpoint")
    check_run("coated", "coated", *MATRIX, "Stages=weave, relax, coat")
    check_run("bent", "bent", *MATRIX, CURVE_ONLY, "Stages=bend", "Bending/Largest angle=0.15", restart=checkpoint)
    moments = [row["bending_moment[N.mm]"] for row in curve("bent")]
    check(f"moment grows with the angle: {moments}", all(a < b for a, b in zip(moments, moments[1:])))
    check_run("pulled", "pulled", *MATRIX, CURVE_ONLY, "Stages=biaxial", "Biaxial/Largest strain=0.005", restart=checkpoint)
    last = curve("pulled")[-1]
    check(f"balanced: warp {last['force_warp[N]']}, fill {last['force_fill[N]']}",
          abs(last["force_warp[N]"] / last["force_fill[N]"] - 1) < 1e-6)
    check_run("pulled after shear", "pulled_sheared", *MATRIX, CURVE_ONLY, "Stages=biaxial", "Biaxial/Largest strain=0.005",
              restart=os.path.join("sheared_1", "checkpoint"))

    check_run("dry", "dry", "Stages=weave")
    check("a dry scene has no matrix", model("dry")["matrix_dofs"] == model("dry")["junctions"] == 0)
    check("  nor files of it", not os.path.exists(os.path.join("dry", "matrix.pvd")))
    dry_bend = ["Stages=relax, bend", "Bending/Largest angle=0.2", CURVE_ONLY]
    for ranks in (1, 2):
        check_run(f"bent dry, ranks: {ranks}", f"dry_bent_{ranks}", *dry_bend, restart=os.path.join("dry", "checkpoint"),
                  ranks=ranks)
    bent, shared = (curve(f"dry_bent_{ranks}")[-1] for ranks in (1, 2))
    check(f"  moment on 2 ranks {shared['bending_moment[N.mm]']}",
          abs(shared["bending_moment[N.mm]"] / bent["bending_moment[N.mm]"] - 1) < 1e-4)
    # Six rods that slide on each other without friction, bent to an arc.
    least = 6 * 73000 * math.pi * .008 ** 4 / 4 * bent["bending_angle[rad]"] / LENGTH
    check(f"  moment {bent['bending_moment[N.mm]'] / least:.2f} times that of loose rods",
          1 < bent["bending_moment[N.mm]"] / least < 3)
    check(f"  force along the fabric {bent['axial_force[N]']}",
          abs(bent["axial_force[N]"]) < 1e-3 * bent["bending_moment[N.mm]"] / .008)

    check_refusal("another matrix", ["Matrix/Young modulus", "restart"], *MATRIX, "Stages=biaxial",
                  "Matrix/Young modulus=60", restart=checkpoint)
    check_refusal("coated twice", ["Stages", "once"], *MATRIX, "Stages=coat", restart=checkpoint)
    woven = os.path.join("dry", "checkpoint")
    from_woven = [*MATRIX, CURVE_ONLY, "Stages=coat, shear", *SHEAR[1:]]
    check_run("from a woven state", "from_woven", *from_woven, restart=woven)
    check_restart("from_woven", 1, *from_woven, restart=woven)
    check_refusal("layers that meet", ["Overlap"], *MATRIX, "Stages=coat", "Matrix/Overlap=0.1",
                  "Matrix/Thickness=0.2", restart=woven)
    check_refusal("a mesh too coarse", ["too coarse", "Cells along x"], *MATRIX, "Stages=coat", "Matrix/Cells along x=1",
                  "Matrix/Cells along y=1", "Matrix/Overlap=0.002", restart=woven)
    done = run(SMALL_WEAVE, "too_coarse", *MATRIX, "Stages=weave, coat", "Matrix/Cells along x=1",
               "Matrix/Cells along y=1", "Matrix/Overlap=0.002", CURVE_ONLY)
    check(f"a mesh too coarse for the woven fabric: status {done.returncode} {done.stderr}",
          done.returncode == 2 and "Cells along x" in done.stderr)
    check_run("  a finer one from there", "finer", *MATRIX, CURVE_ONLY, "Stages=coat",
              restart=os.path.join("too_coarse", "checkpoint"))
    patch = os.path.join(SOURCE, "prm", "verification", "d1_patch.prm")
    check_refusal("no fiber in reach", ["no fiber"], "Matrix/Layers=upper", "Matrix/Size along y=0.01", scene=patch)
    check_refusal("junctions without number, before weaving", ["Matrix/Junction spacing", "larger"], *MATRIX,
                  "Stages=weave, coat", "Matrix/Junction spacing=1e-7")
    check_refusal("no such border", ["Drive left/Matrix borders", "bottom"], "Matrix/Layers=upper",
                  "Drive left/Matrix borders=bottom", scene=patch)
    finish()


sys.exit(main())
