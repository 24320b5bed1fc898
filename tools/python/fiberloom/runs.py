# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors
"""Runs of the program, one or a grid of them."""

import itertools
import os
import shutil
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from .results import Results

# What the program says by its exit status.
MEANING = {1: "bad input", 2: "a stage did not come to rest", 3: "stopped on request"}

# As ./loom sets them; what the user has set counts more.
ENVIRONMENT = {
    # Ranks and runs beside each other share the cores, not each of them all.
    "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1",
    "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    # Two runs of a sweep would bind their ranks to the same cores.
    "OMPI_MCA_hwloc_base_binding_policy": "none",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    # Containers may not permit it.
    "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
    "HWLOC_HIDE_ERRORS": "2",
}


class RunFailed(RuntimeError):
    """A run that did not reach its end.

    ``status`` is the program's exit status, ``message`` the line that it left on stderr and ``results`` what there is
    until then (None where nothing was written).
    """

    def __init__(self, status, message, results):
        # mpirun ends with 1 for reasons of its own.
        known = status in MEANING and (status != 1 or message.startswith("fiberloom: "))
        super().__init__(f"{MEANING[status] if known else f'status {status}'}: {message}")
        self.status, self.message, self.results = status, message, results


def program():
    """Path of the program: $FIBERLOOM, or else build/fiberloom of the checkout that this module is in, or the one on the PATH.

    Throws FileNotFoundError where there is none.
    """
    built = Path(__file__).resolve().parents[3] / "build/fiberloom"
    for found in (os.environ.get("FIBERLOOM"), built if built.exists() else None, shutil.which("fiberloom")):
        if found:
            return str(found)
    raise FileNotFoundError("no program fiberloom: set $FIBERLOOM, or build it")


def run(scene, settings=None, *, output=None, ranks=1, restart=None):
    """Runs a scene to its end and returns its Results.

    ``settings`` are entries by their names, such as {"Contact/Friction coefficient": .3}, over those of the file;
    ``output`` is the output directory, that of the scene by default; ``restart`` a checkpoint to go on from.
    Throws RunFailed where the run does not reach its end.
    """
    command = [program(), str(scene)]
    if ranks > 1:
        command = ["mpirun", "-np", str(ranks), *command]
    for name, value in (settings or {}).items():
        command += ["--set", f"{name}={text(value)}"]
    if output is not None:
        command += ["--output-directory", str(output)]
    if restart is not None:
        command += ["--restart", str(restart)]
    environment = {**ENVIRONMENT, **os.environ}
    directory = Path(output) if output is not None else output_directory(command, environment)
    before = stamp(directory)
    done = subprocess.run(command, capture_output=True, text=True, env=environment)
    # Bad input and a run that ended early leave there what another run has written.
    written = done.returncode == 0 or (done.returncode != 1 and stamp(directory) != before)
    results = Results(directory) if written else None
    if done.returncode:
        own = [line for line in done.stderr.splitlines() if line.startswith("fiberloom: ")]  # mpirun adds lines
        raise RunFailed(done.returncode, own[0] if own else done.stderr.strip(), results)
    return results


def sweep(scene, grid, *, output, settings=None, restart=None, ranks=1, jobs=None):
    """Runs a scene once for each combination of the values in ``grid``, a dictionary of lists.

    Results are in directories 0, 1, ... of ``output``, in the order of itertools.product; ``jobs`` of them run at a
    time, by default as many as there are cores for ``ranks`` each. Returns a list of (values, Results), with RunFailed
    in place of Results where a run did not reach its end; values is a dictionary.
    """
    points = [dict(zip(grid, values)) for values in itertools.product(*grid.values())]
    jobs = jobs or max(1, (os.cpu_count() or 1) // ranks)

    def one(number):
        try:
            return run(scene, {**(settings or {}), **points[number]}, output=Path(output) / str(number), ranks=ranks, restart=restart)
        except RunFailed as failure:
            return failure

    with ThreadPoolExecutor(jobs) as pool:
        return list(zip(points, pool.map(one, range(len(points)))))


def text(value):
    """As a parameter file has it: lists with commas, booleans in small letters."""
    if hasattr(value, "tolist"):
        value = value.tolist()  # numpy's numbers, booleans and arrays
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, (list, tuple)):
        return ", ".join(text(item) for item in value)
    return str(value)


def stamp(directory):
    """Of the summary in a directory, another one whenever it is written; None where there is none."""
    try:
        status = (directory / "summary.json").stat()
    except (AttributeError, OSError):
        return None
    return status.st_mtime_ns, status.st_ino


def output_directory(command, environment):
    """That of the scene with its settings; None where it cannot be read."""
    words = command[command.index(program()):]
    asked = subprocess.run([words[0], "--print-parameters", *words[1:]], capture_output=True, text=True, env=environment)
    for line in asked.stdout.splitlines():
        name, _, value = line.partition("=")
        if name.split() == ["set", "Output", "directory"]:
            return Path(value.split("#")[0].strip())
    return None
