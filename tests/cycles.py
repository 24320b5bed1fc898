# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""A small weave that is pulled and let go twice: what friction costs, and that nothing else does."""

import json
import os
import sys

from program_runs import SMALL_WEAVE, check, check_same, command, curve, finish, interrupt, run

CHECKPOINT = os.path.join("woven", "checkpoint")
PULLED = ["Stages=biaxial", "Biaxial/Way=1, 0, 1, 0", "Solver/Error estimate=false"]


def last_stage(directory):
    with open(os.path.join(directory, "summary.json")) as file:
        return json.load(file)["stages"][-1]


def pull(directory, *settings, **options):
    done = run(SMALL_WEAVE, directory, *PULLED, *settings, restart=CHECKPOINT, **options)
    check(f"{directory}: status {done.returncode} {done.stderr}", done.returncode == 0)
    stage = last_stage(directory)
    return curve(directory), *(stage[f"{name}_per_cycle[mJ]"] for name in
                               ("energy_lost", "friction_loss", "change_of_stored_energy"))


def check_way(rows):
    check("begins without strain", (rows[0]["increment"], rows[0]["load"], rows[0]["strain_warp"]) == (0, 0, 0))
    check("load grows to 1", rows[-1]["load"] == 1 and all(a["load"] < b["load"] for a, b in zip(rows, rows[1:])))
    turns = {load: [row["strain_warp"] for row in rows if row["load"] == load] for load in (.25, .5, .75, 1)}
    check(f"strains where it turns: {turns}", list(turns.values()) == [[.01], [0], [.01], [0]])


def check_energies(rows, lost, friction, stored):
    most = max(row["work[N.mm]"] for row in rows)
    check(f"lost {lost} of {most} mJ", len(lost) == 2 and min(lost) > 1e-3 * most)
    off = [(work - loss - change) / work for work, loss, change in zip(lost, friction, stored)]
    check(f"less friction {friction} and what is stored {stored}: off by {off}", max(map(abs, off)) < .05)
    start, first, second = (next(row for row in rows if row["load"] == load)["force_warp[N]"] for load in (0, .5, 1))
    check(f"forces at the ends of the cycles, {start}, {first}, {second}: the second one closes better",
          abs(second - first) < .5 * abs(first - start))


def check_refused(way, words):
    done = run(SMALL_WEAVE, "refused", f"Biaxial/Way={way}")
    lines = done.stderr.splitlines()
    check(f"refused: {lines}", done.returncode == 1 and len(lines) == 1 and "Biaxial/Way" in lines[0] and words in lines[0])


def main():
    check("woven", run(SMALL_WEAVE, "woven", "Stages=weave, relax").returncode == 0)
    rows, *energies = pull("rubbing")
    check_way(rows)
    check_energies(rows, *energies)

    rows, lost, friction, _ = pull("smooth", "Contact/Friction coefficient=0")
    most = max(row["work[N.mm]"] for row in rows)
    check(f"without friction {lost} of {most} mJ", max(map(abs, lost)) < 1e-2 * most and friction == [0, 0])

    pull("two_ranks", ranks=2)
    check_same("  curve on two ranks", "rubbing", "two_ranks", 1e-4)
    interrupt(command(SMALL_WEAVE, "stopped", *PULLED, restart=CHECKPOINT), "stopped", "stop", 8)
    again = run(SMALL_WEAVE, "stopped", *PULLED, restart=os.path.join("stopped", "checkpoint"))
    check(f"restarted: status {again.returncode} {again.stderr}", again.returncode == 0)
    check_same("  curve of the straight run", "rubbing", "stopped", 1e-10)
    check("  and its cycles", last_stage("stopped")["energy_lost_per_cycle[mJ]"] == energies[0])

    done = run(SMALL_WEAVE, "estimated", "Stages=biaxial", "Biaxial/Way=1, 0", restart=CHECKPOINT)
    error = last_stage("estimated")["estimated_error"]["total"]
    check(f"error estimated where it is farthest: {error}", done.returncode == 0 and 0 < (error or 0) < .2)

    check_refused("1, 1", "apart")
    check_refused("0", "apart")
    check_refused("1, 2", "allowed")
    finish()


sys.exit(main())
