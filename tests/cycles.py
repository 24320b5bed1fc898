# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""A small weave is sheared there and back twice, which friction makes it pay for, and pulled and let go without friction."""

import json
import os
import shutil
import sys

from program_runs import SMALL_WEAVE, check, check_same, command, curve, finish, interrupt, run

CHECKPOINT = os.path.join("woven", "checkpoint")
SHEARED = ["Stages=shear", "Shear/Largest angle=0.2", "Shear/Way=1, 0, 1, 0", "Shear/First step=0.02",
           "Solver/Error estimate=false"]
PULLED = ["Stages=biaxial", "Biaxial/Way=0, 1, 0", "Biaxial/First step=0.5", "Biaxial/Largest step=0.5"]
ENERGIES = "energy_lost", "friction_loss", "change_of_stored_energy"


def last_stage(directory):
    with open(os.path.join(directory, "summary.json")) as file:
        return json.load(file)["stages"][-1]


def test(directory, *settings, **options):
    """Rows of the curve and energies per cycle."""
    done = run(SMALL_WEAVE, directory, *settings, restart=CHECKPOINT, **options)
    check(f"{directory}: status {done.returncode} {done.stderr}", done.returncode == 0)
    return curve(directory), [last_stage(directory)[f"{name}_per_cycle[mJ]"] for name in ENERGIES]


def check_way(rows):
    first = rows[0]
    check("begins at zero", (first["increment"], first["load"], first["shear_angle[rad]"], first["work[N.mm]"]) == (0, 0, 0, 0))
    check("load grows to 1", rows[-1]["load"] == 1 and all(a["load"] < b["load"] for a, b in zip(rows, rows[1:])))
    turns = [[row["shear_angle[rad]"] for row in rows if row["load"] == load] for load in (.25, .5, .75, 1)]
    check(f"angles where it turns: {turns}", turns == [[.2], [0], [.2], [0]])


def check_energies(rows, energies):
    lost = energies[0]
    check(f"lost {lost} mJ", len(lost) == 2 and min(lost) > 0)
    off = [(work - friction - stored) / work for work, friction, stored in zip(*energies)]
    check(f"work, loss by friction and stored energy are off by {off}", abs(off[0]) < .1 and abs(off[1]) < .03)
    start, first, second = (next(row for row in rows if row["load"] == load)["shear_force[N]"] for load in (0, .5, 1))
    check(f"forces between the cycles, {start}, {first}, {second}: the second one closes",
          abs(second - first) < .05 * abs(first - start))


def check_remaining(directory, increments):
    """The log counts the increments to come at the mean of those before, on each leg as it is."""
    with open(os.path.join(directory, "log.txt")) as log:
        lines = [line.split() for line in log if "remaining" in line]
    shown = [(float(line[line.index("remaining") - 2]), float(line[-2])) for line in lines]
    check(f"what remains, {increments} times: {shown}",
          len(shown) == increments > 0 and
          all((remaining - .05) * done <= (len(shown) - done) * (seconds + .05) + 1e-9 and
              (remaining + .05) * done >= (len(shown) - done) * (seconds - .05) - 1e-9
              for done, (seconds, remaining) in enumerate(shown, 1)))


def check_restarts(lost):
    """From the middle of the second cycle, on one and on two ranks."""
    shutil.rmtree("stopped_1", ignore_errors=True)
    status = interrupt(command(SMALL_WEAVE, "stopped_1", *SHEARED, restart=CHECKPOINT), "stopped_1", "stop", 13)
    shutil.rmtree("stopped_2", ignore_errors=True)
    shutil.copytree("stopped_1", "stopped_2")
    for ranks, tolerance in ((1, 1e-10), (2, 1e-4)):
        name = f"stopped_{ranks}"
        again = run(SMALL_WEAVE, name, *SHEARED, restart=os.path.join(name, "checkpoint"), ranks=ranks)
        check(f"stopped, status {status}, goes on on {ranks} ranks: status {again.returncode} {again.stderr}",
              (status, again.returncode) == (3, 0))
        check_same("  curve of the straight run", "rubbing", name, tolerance)
        found = last_stage(name)["energy_lost_per_cycle[mJ]"]
        check(f"  and its cycles: {found}", len(found) == len(lost) == 2 and
              all(abs(a / b - 1) <= 10 * tolerance for a, b in zip(found, lost)))


def check_refused(way, words):
    done = run(SMALL_WEAVE, "refused", f"Biaxial/Way={way}")
    lines = done.stderr.splitlines()
    check(f"refused: {lines}", done.returncode == 1 and len(lines) == 1 and "Biaxial/Way" in lines[0] and words in lines[0])


def main():
    check("woven", run(SMALL_WEAVE, "woven", "Stages=weave, relax").returncode == 0)
    rows, energies = test("rubbing", *SHEARED)
    check_way(rows)
    check_energies(rows, energies)
    check_remaining("rubbing", len(rows) - 1)
    check_restarts(energies[0])

    rows, (lost, friction, _) = test("smooth", *PULLED, "Contact/Friction coefficient=0")
    most = max(row["work[N.mm]"] for row in rows)
    check(f"without friction {lost} of {most} mJ", abs(lost[0]) < 1e-2 * most and friction == [0])
    error = last_stage("smooth")["estimated_error"]["total"]
    check(f"  error estimated where it is farthest: {error}", 0 < (error or 0) < .2)

    done = run(SMALL_WEAVE, "free", *PULLED, "Biaxial/Way=1", "Biaxial/Other direction=free", "Solver/Error estimate=false",
               restart=CHECKPOINT)
    last = curve("free")[-1]
    check(f"free across the pull, status {done.returncode}: {last['force_warp[N]']} of {last['force_fill[N]']} N, "
          f"strain {last['strain_warp']}", abs(last["force_warp[N]"]) < 1e-4 * last["force_fill[N]"] and
          -.01 < last["strain_warp"] < -.001)

    check_refused("1, 1", "apart")
    check_refused("0", "apart")
    check_refused("0.0005, 1", "apart")
    check_refused("1, 2", "allowed")
    finish()


sys.exit(main())
