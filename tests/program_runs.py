# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""What the tests that run the whole program share.

Each is called as

    NAME.py PROGRAM SOURCE_DIRECTORY

in a directory of its own, and fails by the status of its process, after a line
for each thing that it checks.
"""

import csv
import os
import shutil
import subprocess
import sys
import time

PROGRAM, SOURCE = sys.argv[1:3]
SCENES = os.path.join(SOURCE, "tests", "scenes")
SMALL_WEAVE = os.path.join(SCENES, "small_weave.prm")

# Ranks may be more than cores: let those that wait give way.
os.environ.setdefault("OMPI_MCA_mpi_yield_when_idle", "1")

failures = 0


def check(what, good):
    global failures
    failures += not good
    print(f"{'ok   ' if good else 'WRONG'} {what}", flush=True)


def finish():
    sys.exit(failures > 0)


def command(scene, directory, *settings, ranks=1, restart=None, keep=False):
    """Arguments of a run of `scene` into a directory that is emptied unless it goes on."""
    if restart is None and not keep:
        shutil.rmtree(directory, ignore_errors=True)
    words = ["mpirun", "-np", str(ranks), "--oversubscribe"] if ranks > 1 else []
    words += [PROGRAM, scene, "--output-directory", directory]
    for setting in settings:
        words += ["--set", setting]
    return words + (["--restart", restart] if restart else [])


def run(*arguments, **options):
    """The finished process."""
    return subprocess.run(command(*arguments, **options), capture_output=True, text=True)


def curve(directory, file="loading_curve.csv"):
    """Rows of loading_curve.csv, or of reactions.csv; numbers where there are numbers."""
    with open(os.path.join(directory, file)) as rows:
        return [{name: cell if name in ("stage", "body") else float(cell) for name, cell in row.items() if cell}
                for row in csv.DictReader(rows)]


def n_rows(directory):
    """Rows of its curve so far."""
    try:
        return len(curve(directory))
    except OSError:
        return 0


def interrupt(arguments, directory, how, after_rows):
    """Status of a run that is interrupted once its curve has so many rows."""
    process = subprocess.Popen(arguments,
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while n_rows(directory) < after_rows and process.poll() is None:
        time.sleep(.01)
    if how == "stop":
        open(os.path.join(directory, "stop"), "w").close()
    else:
        process.send_signal(how)
    return process.wait()


def unit(column):
    return column[column.index("["):] if "[" in column else column


def difference(one, other, file):
    """Largest difference of two files, over the largest value of that unit; None if rows differ."""
    one, other = curve(one, file), curve(other, file)
    if [row.keys() for row in one] != [row.keys() for row in other]:
        return None
    scale = {}
    for row in one:
        for name, value in row.items():
            if not isinstance(value, str):
                scale[unit(name)] = max(scale.get(unit(name), 1e-300), abs(value))
    if any(a[name] != b[name] for a, b in zip(one, other) for name in a if isinstance(a[name], str)):
        return None
    return max((abs(a[name] - b[name]) / scale[unit(name)]
                for a, b in zip(one, other) for name in a if not isinstance(a[name], str)), default=None)


def check_same(what, one, other, tolerance, file="loading_curve.csv"):
    found = difference(one, other, file)
    shown = "rows differ" if found is None else f"differs by {found:.1e}, allowed {tolerance:.0e}"
    check(f"{what}: {shown}", found is not None and found <= tolerance)
