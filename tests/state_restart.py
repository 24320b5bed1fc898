# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""A run that is interrupted in any way and restarted leaves the loading curve of the straight run."""

import os
import shutil
import signal
import subprocess
import sys
import time

from program_runs import SCENES, SMALL_WEAVE, check, check_same, command, curve, finish, interrupt, n_rows, run


def check_same_files(straight, directory, ranks=1):
    """On 2 ranks the factor's sums come in any order: straight runs differ from each other by 1e-11, too."""
    for file in ("loading_curve.csv", "reactions.csv"):
        check_same(f"  {file}", straight, directory, 1e-10 if ranks == 1 else 1e-8, file)


def check_restart(name, how, after_rows, *settings, straight=None, ranks=1, status=3, scene=SMALL_WEAVE):
    directory, straight = f"{name}_{ranks}", straight or f"straight_{ranks}"
    found = interrupt(command(scene, directory, *settings, ranks=ranks), directory, how, after_rows)
    check(f"{name} on {ranks} ranks: status {found}, expected {status}", found == status)
    rows = n_rows(directory)
    check(f"  interrupted within the run, after {rows} rows", after_rows <= rows < n_rows(straight))
    again = run(scene, directory, *settings, ranks=ranks, restart=os.path.join(directory, "checkpoint"))
    check(f"  restarted: status {again.returncode} {again.stderr}", again.returncode == 0)
    check_same_files(straight, directory, ranks)


def check_memory():
    """What contacts remember, where it decides: half woven with friction; a class kept by hysteresis."""
    nested = ["Stages=weave", "Weaving/Path=nested", "Fabric/Warp/Fibers per tow=2"]
    done = run(SMALL_WEAVE, "weaving", *nested)
    check(f"woven in {n_rows('weaving')} increments", done.returncode == 0)
    check_restart("weave", "stop", 1, *nested, straight="weaving")

    turning = os.path.join(SCENES, "turning_fibers.prm")
    check("turning", run(turning, "turning").returncode == 0)
    check_restart("turn", "stop", 31, straight="turning", scene=turning)


def check_stop_at_once():
    """Before the first increment is accepted."""
    shutil.rmtree("at_once", ignore_errors=True)
    os.makedirs("at_once")
    open(os.path.join("at_once", "stop"), "w").close()
    stopped = run(SMALL_WEAVE, "at_once", keep=True)
    check(f"stop at once: status {stopped.returncode}", stopped.returncode == 3 and n_rows("at_once") == 0)
    check("  stop is removed", not os.path.exists(os.path.join("at_once", "stop")))
    again = run(SMALL_WEAVE, "at_once", restart=os.path.join("at_once", "checkpoint"))
    check(f"  restarted: status {again.returncode}", again.returncode == 0)
    check_same_files("straight_1", "at_once")


def check_coarse_start():
    """Killed once the coarser meshes of a weave have come to rest, before its only increment."""
    finer = ["Stages=weave, relax", "Fabric/Warp/Elements per fiber=24"]
    check("finer", run(SMALL_WEAVE, "finer", *finer).returncode == 0)
    shutil.rmtree("coarse", ignore_errors=True)
    checkpoint = os.path.join("coarse", "checkpoint")
    process = subprocess.Popen(command(SMALL_WEAVE, "coarse", *finer),
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while process.poll() is None and not os.path.exists(checkpoint):
        time.sleep(.001)
    process.kill()
    process.wait()
    check("  killed before it is woven", os.path.exists(checkpoint) and n_rows("coarse") == 0)
    again = run(SMALL_WEAVE, "coarse", *finer, restart=checkpoint)
    check(f"  restarted: status {again.returncode} {again.stderr}", again.returncode == 0)
    check("  without the coarser meshes", "elements first" not in again.stdout)
    check_same_files("finer", "coarse")


def check_lists():
    """Which stages a restart does, by what the checkpoint has behind it."""
    check("woven", run(SMALL_WEAVE, "woven", "Stages=weave, relax").returncode == 0)
    checkpoint = os.path.join("woven", "checkpoint")
    for stages in ("biaxial", "weave, relax, biaxial"):
        check(f"on from there: {stages}",
              run(SMALL_WEAVE, "on", f"Stages={stages}", restart=checkpoint).returncode == 0)
        check("  only what is left is done", {row["stage"] for row in curve("on")} == {"biaxial"})
    straight = [row for row in curve("straight_1") if row["stage"] == "biaxial"]
    check("  with the same result", [row["force_warp[N]"] for row in straight] ==
          [row["force_warp[N]"] for row in curve("on")])

    # A run that had started from another's state is interrupted itself.
    pull = "Stages=biaxial"
    check("pulled", run(SMALL_WEAVE, "pulled", pull, restart=checkpoint).returncode == 0)
    shutil.rmtree("later", ignore_errors=True)
    interrupt(command(SMALL_WEAVE, "later", pull, restart=checkpoint), "later", "stop", 4)
    check(f"  interrupted after {n_rows('later')} rows", 4 <= n_rows("later") < n_rows("pulled"))
    again = run(SMALL_WEAVE, "later", pull, restart=os.path.join("later", "checkpoint"))
    check(f"  restarted: status {again.returncode}", again.returncode == 0)
    check_same_files("pulled", "later")
    done = run(SMALL_WEAVE, "later", pull, restart=os.path.join("later", "checkpoint"))
    check("nothing is left of it", done.returncode == 0 and "nothing is left to do" in done.stdout)

    done = run(SMALL_WEAVE, "woven", "Stages=weave, relax", restart=checkpoint)
    check("nothing is left", done.returncode == 0 and "nothing is left to do" in done.stdout)
    check("  and the files stay", n_rows("woven") == 2)

    repeated = run(SMALL_WEAVE, "repeated", "Stages=weave, relax, biaxial, relax")
    fields = os.listdir(os.path.join("repeated", "fields"))
    check("a repeated stage has files of its own", repeated.returncode == 0 and
          "fibers_relax_0001.pvtu" in fields and any(name.startswith("fibers_relax_3_") for name in fields))


def main():
    for ranks in (1, 2):
        check(f"straight on {ranks} ranks", run(SMALL_WEAVE, f"straight_{ranks}", ranks=ranks).returncode == 0)
    check_restart("stop", "stop", 3)
    check_restart("terminate", signal.SIGTERM, 5)
    check_restart("user", signal.SIGUSR1, 1)
    check_restart("kill", signal.SIGKILL, 6, status=-signal.SIGKILL)
    check_restart("stop", "stop", 4, ranks=2)
    check_stop_at_once()
    check_memory()
    check_coarse_start()
    check_lists()
    finish()


sys.exit(main())
