# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""Holds the program to its reference cases.

    verify.py PROGRAM [--ranks N] [--work DIRECTORY] [--write FILE] [--quick] [CASE ...]

A case is a module NAME.py beside this one, for the scenes prm/verification/NAME*.prm.
Its docstring says what it is (first line) and where the reference comes from; QUICK says
whether the tests run it; judge(run) yields a Check for each number. `run(*settings,
scene=NAME)` runs a scene and gives its Result; runs that are asked for twice are done once.

Prints a table: case, quantity, reference, computed, error, tolerance, seconds, verdict,
and ends with status 1 if a case falls short. --write puts the table into a document
behind the line that says it is generated, with the docstring of each case and its picture
../pictures/verification/NAME.png where there is one beside the document's directory.
"""

import argparse
import csv
import importlib
import json
import os
import resource
import shutil
import subprocess
import sys
import time
import traceback

HERE = os.path.dirname(os.path.abspath(__file__))
SCENES = os.path.join(HERE, "..", "..", "prm", "verification")
sys.path[:0] = [HERE, os.path.join(HERE, "..")]

from documents import markdown_table, replace_block

HEADER = ["case", "quantity", "reference", "computed", "error", "tolerance", "seconds", "verdict"]
LIMIT = 900  # seconds of a run
MARK = "<!-- generated from here on by ./loom verify -->"


class Result:
    """What one run left behind."""

    def __init__(self, directory, cpu_seconds):
        self.directory = directory
        self.cpu_seconds = cpu_seconds  # of all ranks
        with open(os.path.join(directory, "summary.json")) as file:
            self.summary = json.load(file)
        self.rows = self.table("loading_curve.csv")

    def table(self, name):
        """Rows of a CSV file of the run; numbers where there are numbers."""

        def number(cell):
            try:
                return float(cell)
            except ValueError:
                return cell

        with open(os.path.join(self.directory, name)) as file:
            return [{key: number(cell) for key, cell in row.items() if cell not in ("", None)}
                    for row in csv.DictReader(file)]

    @property
    def increments(self):
        """Rows without those of the states in which stages begin."""
        return [row for row in self.rows if row["increment"] > 0]

    @property
    def last(self):
        return self.rows[-1]

    def at(self, column, value):
        """The row whose entry is nearest to a value."""
        return min(self.rows, key=lambda row: abs(row[column] - value))

    @property
    def penetration(self):
        """Largest over the radius, in any stage."""
        return max(stage["largest_penetration_over_radius"] for stage in self.summary["stages"])

    @property
    def newton_iterations(self):
        return sum(stage["newton_iterations"] for stage in self.summary["stages"])


def verify(arguments):
    rows = []
    for name in arguments.cases or case_names(arguments.quick):
        n_before = len(rows)
        case = importlib.import_module(name)
        runner = Runner(name, arguments)
        checks, broken = [], False
        try:
            for check in case.judge(runner):
                checks.append(check)
        except Exception:  # a run that does not end has failed, the others go on
            traceback.print_exc()
            broken = True
        for check in checks:
            rows.append([name, check.quantity, check.shown_reference(), f"{check.computed:.7g}", check.shown_error(),
                         check.shown_tolerance(), f"{runner.seconds:.1f}", check.verdict()])
        if broken or not checks:
            rows.append([name, "a run that did not end", "", "", "", "", f"{runner.seconds:.1f}", "FAILED"])
        for row in rows[n_before:]:
            print(" | ".join(row), flush=True)
    failed, good = (sum(row[-1] == verdict for row in rows) for verdict in ("FAILED", "ok"))
    print(f"{good} of {good + failed} numbers within their tolerance")
    if arguments.write:
        write_table(arguments.write, rows)
    return failed > 0


class RunFailed(RuntimeError):
    """A run that did not end with status 0."""

    def __init__(self, words, done):
        self.status, self.message = done.returncode, done.stderr.strip()
        super().__init__(f"{' '.join(words)}: status {self.status}: {self.message[-300:]}")


class Runner:
    def __init__(self, name, arguments):
        self.name = name
        self.arguments = arguments
        self.results = {}
        self.seconds = 0

    def __call__(self, *settings, scene=None, restart=None):
        scene = scene or self.name
        key = (scene, settings, restart)
        if key not in self.results:
            directory = os.path.join(self.arguments.work,
                                     f"{os.path.basename(scene)}_{len(self.results)}_{self.arguments.ranks}")
            shutil.rmtree(directory, ignore_errors=True)
            ranks = self.arguments.ranks
            words = ["mpirun", "-q", "-np", str(ranks), "--oversubscribe"] if ranks > 1 else []
            words += [self.arguments.program, os.path.join(SCENES, scene + ".prm"), "--output-directory", directory]
            for setting in settings:
                words += ["--set", setting]
            if restart:
                words += ["--restart", os.path.join(restart.directory, "checkpoint")]
            start, cpu_start = time.time(), cpu_of_children()
            done = subprocess.run(words, capture_output=True, text=True, timeout=LIMIT)
            self.seconds += time.time() - start
            if done.returncode != 0:
                raise RunFailed(words, done)
            self.results[key] = Result(directory, cpu_of_children() - cpu_start)
        return self.results[key]


def cpu_of_children():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def case_names(quick):
    names = sorted(name[:-3] for name in os.listdir(HERE)
                   if name.endswith(".py") and name[0] in "abcdk" and name[1].isdigit())
    names.sort(key=lambda name: (name[0], int(name[1:].split("_")[0])))
    return [name for name in names if not quick or importlib.import_module(name).QUICK]


def describe(name, directory):
    text = f"### {name}\n\n{importlib.import_module(name).__doc__.strip()}"
    picture = f"../pictures/verification/{name}.png"
    if os.path.exists(os.path.join(directory, picture)):
        text += f"\n\n![{name}]({picture})"
    return text


def write_table(file, rows):
    cases = "\n\n".join(describe(name, os.path.dirname(file)) for name in dict.fromkeys(row[0] for row in rows))
    replace_block(file, f"{markdown_table(HEADER, rows)}\n\n## The cases\n\n{cases}", MARK)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("cases", nargs="*")
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--work", default="verification")
    parser.add_argument("--write")
    parser.add_argument("--quick", action="store_true")
    sys.exit(verify(parser.parse_intermixed_args()))


if __name__ == "__main__":
    main()
