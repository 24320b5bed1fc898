# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""Runs a scene of tests/ and writes the numbers it asks for to `output`.

    run_scene.py PROGRAM SCENE.prm

The scene says in comments how it is run and what is compared:

    # options: --set "Accuracy=draft"         further options
    # status: 2                               expected exit status, 0 if absent
    # stderr: must be positive                text that stderr's one line contains
    # value: warp over fill = last("biaxial", "force_warp[N]") / last("biaxial", "force_fill[N]")

The right-hand side is Python and sees

    summary           summary.json
    stage(NAME)       the stage's entry in it
    column(STAGE, NAME)   a column of loading_curve.csv as a list of floats
    last(STAGE, NAME)     its last number
    exists(FILE)      whether a file is in the output directory
    math

Under mpirun every rank comes here; only the first writes.
"""

import csv
import json
import math
import os
import re
import shlex
import shutil
import subprocess
import sys

DIRECTORY = "results"


def directives(scene):
    """(word, text) of each `# word: text` in the file."""
    with open(scene) as lines:
        found = (re.match(r"#\s*(options|status|stderr|value):\s*(.+)", line) for line in lines)
        return [(match[1], match[2].strip()) for match in found if match]


class Results:
    """What the values of a scene can refer to; files are read when used."""

    math = math

    @property
    def summary(self):
        with open(os.path.join(DIRECTORY, "summary.json")) as file:
            return json.load(file)

    def stage(self, name):
        return next(stage for stage in self.summary["stages"] if stage["name"] == name)

    def column(self, stage, name):
        with open(os.path.join(DIRECTORY, "loading_curve.csv")) as file:
            return [float(row[name]) for row in csv.DictReader(file) if row["stage"] == stage]

    def last(self, stage, name):
        return self.column(stage, name)[-1]

    def exists(self, name):
        return os.path.exists(os.path.join(DIRECTORY, name))

    def names(self):
        public = (name for name in dir(self) if not name.startswith("_") and name not in ("names", "summary"))
        return {name: getattr(self, name) for name in public}


def value_lines(values):
    results = Results()
    for text in values:
        name, expression = text.split("=", 1)
        names = results.names()
        if "summary" in expression:
            names["summary"] = results.summary
        value = eval(expression, names)
        yield f"{name.strip()}: {value if isinstance(value, (bool, str)) else format(value, '.10g')}"


def main():
    program, scene = sys.argv[1:]
    wanted = directives(scene)
    rank = int(os.environ.get("OMPI_COMM_WORLD_RANK", 0))
    if rank == 0:
        shutil.rmtree(DIRECTORY, ignore_errors=True)
    options = [option for word, text in wanted if word == "options" for option in shlex.split(text)]
    expected = next((int(text) for word, text in wanted if word == "status"), 0)
    run = subprocess.run([program, scene, "--output-directory", DIRECTORY, *options],
                         stderr=subprocess.PIPE, text=True)
    sys.stderr.write(run.stderr)
    if run.returncode != expected:
        return f"exit status {run.returncode}, expected {expected}"
    if rank != 0:
        return 0
    for text in (text for word, text in wanted if word == "stderr"):
        if len(run.stderr.splitlines()) != 1 or text not in run.stderr:
            return f"stderr is not one line with '{text}'"
    lines = list(value_lines(text for word, text in wanted if word == "value"))
    with open("output", "w") as output:
        output.write("\n".join([f"exit status: {run.returncode}", *lines, ""]))
    return 0


sys.exit(main())
