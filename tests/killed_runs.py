# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""Runs of four scenes that are killed at random moments and restarted, on 1 and 2 ranks in turn, leave the
curves, the summary and the estimated error of the straight run.

    killed_runs.py PROGRAM SOURCE_DIRECTORY [--kills N] [--seed S]
"""

import argparse
import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import time

from program_runs import SCENES, SMALL_WEAVE, SOURCE, check, check_same, command, curve, finish

MATRIX = ["Matrix/Layers=both", "Matrix/Cells along x=3", "Matrix/Cells along y=3", "Stages=weave, relax, coat, shear",
          "Shear/Largest angle=0.2", "Shear/Largest step=0.05"]
TABLES = ["loading_curve.csv", "reactions.csv"]
# Name, scene, settings, by how much ranks may differ, in what, and what an estimate does not resolve. On turning fibers
# moments are only rounding, and the error of the mesh is below the tolerance of the draft.
RUNS = [("weave", SMALL_WEAVE, [], 1e-4, TABLES, 1e-9),
        ("turning", os.path.join(SCENES, "turning_fibers.prm"), [], 1e-6, TABLES[:1], 1e-3),
        ("composite", SMALL_WEAVE, MATRIX, 1e-4, TABLES, 1e-9),
        ("strand", os.path.join(SOURCE, "prm", "strand.prm"), [], 1e-4, TABLES, 1e-9)]


def descendants(pid):
    """Of a process: mpirun gives its ranks groups of their own."""
    found = [pid]
    for entry in os.listdir("/proc"):
        try:
            with open(f"/proc/{entry}/stat") as file:
                parent = int(file.read().rpartition(")")[2].split()[1]) if entry.isdigit() else None
        except OSError:
            continue
        if parent == pid:
            found += descendants(int(entry))
    return found


def is_running(pid):
    try:
        with open(f"/proc/{pid}/stat") as file:
            return file.read().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def start(run, directory, ranks):
    """A run into a directory, from the checkpoint there if there is one."""
    _, scene, settings, *_ = run
    checkpoint = os.path.join(directory, "checkpoint")
    restart = checkpoint if os.path.exists(checkpoint) else None
    return subprocess.Popen(command(scene, directory, *settings, ranks=ranks, restart=restart, keep=True),
                            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)


def killed_after(process, seconds):
    """Whether it was still running then."""
    try:
        process.wait(seconds)
        return False
    except subprocess.TimeoutExpired:
        pids = descendants(process.pid)
        for pid in pids:
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        process.wait()
        while any(is_running(pid) for pid in pids):
            time.sleep(.01)
        return True


def stages(directory):
    with open(os.path.join(directory, "summary.json")) as file:
        summary = json.load(file)
    return summary["converged"], summary["stages"]


def differs(one, other, tolerance, negligible=1e-9):
    if one is None or other is None:
        return one is not other
    return abs(one - other) > tolerance * max(abs(one), abs(other)) + negligible


def check_summary(straight, directory, tolerance, unresolved):
    (good, before), (also_good, after) = stages(straight), stages(directory)
    exact = ("name", "converged", "increments", "rejected_increments", "crossings_out_of_order")
    same = [[stage[name] for name in exact] for stage in before] == [[stage[name] for name in exact] for stage in after]
    check("  summary", good and also_good and same)
    pairs = list(zip(before, after))
    check("  penetration", not any(differs(a["largest_penetration_over_radius"], b["largest_penetration_over_radius"],
                                           100 * tolerance) for a, b in pairs))
    # The few iterations of an estimate take what the tolerance leaves for an error.
    check("  estimated error", not any(differs(a["estimated_error"][part], b["estimated_error"][part], .05, unresolved)
                                       for a, b in pairs for part in a["estimated_error"]))


def check_log(directory):
    """One line for each increment, and one name."""
    with open(os.path.join(directory, "log.txt")) as file:
        text = file.read()
    lines = re.findall(r"^(\w+) +(\d+)  load \d", text, re.M)
    rows = [(row["stage"], str(int(row["increment"]))) for row in curve(directory) if row["increment"] > 0]
    check("  log: no increment twice", lines == rows and len(re.findall(r"^run \w{16}$", text, re.M)) == 1)


def check_run(run, n_kills, chance, seconds):
    """As many kills as told, over as many runs as that takes."""
    name, _, _, tolerance, tables, unresolved = run
    straight, directory = name, name + "_killed"
    kills = attempt = 0
    while kills < n_kills:
        shutil.rmtree(directory, ignore_errors=True)
        moments, killed = [], True
        while killed:
            begin = time.time()
            process = start(run, directory, 1 + attempt % 2)
            attempt += 1
            moments.append(chance.uniform(0, 1.1 * seconds) if kills < n_kills else 600)
            killed = killed_after(process, moments[-1])
            kills += killed
        if len(moments) == 1:
            seconds = min(seconds, time.time() - begin)
        check(f"{name}, killed after {', '.join(f'{m:.2f}' for m in moments[:-1])} s: status {process.returncode} "
              f"{process.stderr.read().strip()}", process.returncode == 0)
        for file in tables:
            check_same(f"  {file}", straight, directory, tolerance, file)
        check_summary(straight, directory, tolerance, unresolved)
        check_log(directory)
    return kills


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("source")
    parser.add_argument("--kills", type=int, default=8)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    chance = random.Random(options.seed)
    kills = 0
    for number, run in enumerate(RUNS):
        shutil.rmtree(run[0], ignore_errors=True)
        begin = time.time()
        process = start(run, run[0], 1)
        process.wait()
        check(f"{run[0]}: status {process.returncode}", process.returncode == 0)
        share = options.kills * (number + 1) // len(RUNS) - options.kills * number // len(RUNS)
        kills += check_run(run, share, chance, time.time() - begin)
    print(f"{kills} kills, seed {options.seed}")
    finish()


sys.exit(main())
