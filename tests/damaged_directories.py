# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""What the outside does to a run and its directory: another run there, kills, planted links and pipes, a closed
screen, too little memory, little time. Each ends with the right status and one line, and nothing is lost."""

import json
import os
import resource
import shutil
import signal
import subprocess
import sys
import time

from program_runs import SMALL_WEAVE, check, check_same, command, curve, finish, run

WOVEN = ["Stages=weave, relax"]


def begun(directory, *settings, ranks=1, until="parameters.prm", **options):
    """A process that has got as far as writing a file, or to its end."""
    process = subprocess.Popen(command(SMALL_WEAVE, directory, *settings, ranks=ranks, **options),
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    while not os.path.exists(os.path.join(directory, until)) and process.poll() is None:
        time.sleep(.001)
    return process


def check_refused(what, done, word):
    lines = [line for line in done.stderr.splitlines() if line.startswith("fiberloom")]
    check(f"{what}: status {done.returncode}, {lines}", done.returncode == 1 and len(lines) == 1 and word in lines[0])


def content(directory, file):
    with open(os.path.join(directory, file)) as text:
        return text.read()


def summary(directory):
    return json.loads(content(directory, "summary.json"))


def check_lock():
    for ranks in (1, 2):
        first = begun("two", ranks=ranks)
        # Held, so that it cannot end before the second has started, which takes Open MPI seconds in a container.
        of_first = int(content("two", "lock").split()[1])
        os.kill(of_first, signal.SIGSTOP)
        check_refused(f"a second run in the directory of one on {ranks} ranks",
                      run(SMALL_WEAVE, "two", keep=True, ranks=3 - ranks), "in use by process")
        os.kill(of_first, signal.SIGCONT)
        check("  the first is not disturbed", first.wait() == 0)
        check_same("  loading_curve.csv", "straight", "two", 1e-4)
    killed = begun("two")
    killed.send_signal(signal.SIGKILL)
    killed.wait()
    check("a lock that a killed run has left", os.path.exists(os.path.join("two", "lock")))
    check("  locks nothing", run(SMALL_WEAVE, "two", *WOVEN, keep=True).returncode == 0)
    check("  and goes with the next run", not os.path.exists(os.path.join("two", "lock")))


def check_identity():
    """A run into a used directory, killed before its first checkpoint."""
    other, checkpoint = "Contact/Friction coefficient=0.9", os.path.join("used", "checkpoint")
    check("a directory is used", run(SMALL_WEAVE, "used", *WOVEN).returncode == 0)
    before = content("used", "log.txt").splitlines()[0]
    check("  its files have one name", before == "run " + summary("used")["run"] and
          before in content("used", "parameters.prm"))
    check_refused("nothing left, and other values", run(SMALL_WEAVE, "used", *WOVEN, other, restart=checkpoint),
                  "other values (Contact/Friction coefficient = 0.9, which was 0.2)")

    os.remove(os.path.join("used", "parameters.prm"))
    killed = begun("used", *WOVEN, other, keep=True)
    killed.send_signal(signal.SIGKILL)
    killed.wait()
    check_refused("killed before its first checkpoint", run(SMALL_WEAVE, "used", *WOVEN, other, restart=checkpoint),
                  "No such file")
    kept = os.path.join("used", "checkpoint.before")
    check("  the one before is kept", os.path.exists(kept) and "checkpoint.before" in content("used", "log.txt"))
    check("  and can be gone on from", run(SMALL_WEAVE, "on", "Stages=weave, relax, biaxial", restart=kept).returncode == 0)
    check("started anew", run(SMALL_WEAVE, "used", *WOVEN, other, keep=True).returncode == 0)
    check("  under another name", content("used", "log.txt").splitlines()[0] != before)
    check_refused("what would replace it", run(SMALL_WEAVE, "used", *WOVEN, restart=kept), "would replace")
    check("  both are still there", os.path.exists(kept) and os.path.exists(checkpoint))


def check_planted():
    """Links and pipes under names of files, and under those by which these are made."""
    shutil.rmtree("planted", ignore_errors=True)
    os.makedirs("planted")
    with open("precious", "w") as file:
        file.write("precious")
    for name in ("log.txt", "loading_curve.csv.tmp", "checkpoint.tmp", "parameters.prm"):
        os.symlink("../precious", os.path.join("planted", name))
    for name in ("loading_curve.csv", "reactions.csv.tmp", "summary.json", "summary.json.tmp", "checkpoint"):
        os.mkfifo(os.path.join("planted", name))
    done = subprocess.run(command(SMALL_WEAVE, "planted", keep=True), capture_output=True, text=True, timeout=100)
    check(f"planted links and pipes: status {done.returncode} {done.stderr}", done.returncode == 0)
    check("  nothing is written through a link", content(".", "precious") == "precious")
    check_same("  loading_curve.csv", "straight", "planted", 1e-10)
    check("  files are files", all(os.path.isfile(path) and not os.path.islink(path) for path in (
        os.path.join("planted", name) for name in ("log.txt", "parameters.prm", "summary.json", "checkpoint"))))
    os.mkfifo(os.path.join("planted", "lock"))
    check_refused("a pipe as lock", run(SMALL_WEAVE, "planted", keep=True), "is not a file")


def check_screen():
    process = subprocess.Popen(command(SMALL_WEAVE, "screen"), stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    process.stdout.readline()
    process.stdout.close()
    check(f"a screen that is closed: status {process.wait()}", process.returncode == 0)
    check("  the log goes on", len(content("screen", "log.txt").splitlines()) > len(curve("straight")))


def end_after_last_increment(how):
    """Status of a run that gets a signal there; another try where it was at its end by then."""
    for _ in range(5):
        process = begun("estimate", until="loading_curve.csv")
        while len(curve("estimate")) < len(curve("straight")) and process.poll() is None:
            time.sleep(.001)
        process.send_signal(how)
        if process.wait() != 0:
            break
    return process.returncode


def check_end_of_stage():
    """Between the last increment and the end of its stage, where the error is estimated."""
    good = summary("straight")["stages"][-1]["estimated_error"]
    for how, expected in ((signal.SIGKILL, -signal.SIGKILL), (signal.SIGTERM, 3)):
        status = end_after_last_increment(how)
        check(f"{how.name} after the last increment: status {status}", status == expected)
        again = run(SMALL_WEAVE, "estimate", restart=os.path.join("estimate", "checkpoint"))
        check(f"  restarted: status {again.returncode}", again.returncode == 0)
        check_same("  loading_curve.csv", "straight", "estimate", 1e-10)
        found = summary("estimate")["stages"][-1]
        check("  the estimated error is there", found["estimated_error"] == good and found["converged"])
        check("  and no increment is counted twice",
              found["increments"] == summary("straight")["stages"][-1]["increments"])


def check_limits():
    """Without memory for its buffers BLAS would try for ever."""
    most = 800 << 20
    done = subprocess.run(command(SMALL_WEAVE, "limited"), capture_output=True, text=True, timeout=100,
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (most, most)))
    check(f"too little memory: status {done.returncode}, {done.stderr.strip()}", done.returncode == 2 and
          len(done.stderr.splitlines()) == 1 and "GiB" in done.stderr and not os.path.exists("limited"))
    done = run(SMALL_WEAVE, "time", "Maximal wall time=0.1")
    check(f"too little time: status {done.returncode}", done.returncode == 3)
    again = run(SMALL_WEAVE, "time", restart=os.path.join("time", "checkpoint"))
    check(f"  restarted: status {again.returncode}", again.returncode == 0)
    check_same("  loading_curve.csv", "straight", "time", 1e-10)


def main():
    check("straight", run(SMALL_WEAVE, "straight").returncode == 0)
    check_lock()
    check_identity()
    check_planted()
    check_screen()
    check_end_of_stage()
    check_limits()
    finish()


sys.exit(main())
