# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""Turns one knob after the other to its extremes.

    extremes.py PROGRAM [--work DIRECTORY] [--write FILE] [--quick] [ROW ...]
    extremes.py PROGRAM --weaves N [--first N] [--seed N] [--jobs N] [--work DIRECTORY]

Rows are in rows.py, on scenes of prm/verification. A run has survived if it ends with status 0
and its numbers are within their tolerance; is refused if its input is (status 1), failed if it
gives up (status 2), each with one line that names a setting; is wrong if a number is off; crashed
otherwise.

Prints a table: row, value, quantity, verdict, Newton iterations, error, tolerance, CPU seconds,
and what those that were refused or failed said. Ends with status 1 if something is wrong or
crashed. --write puts both into a document behind the line that says it is generated, after each
row, and pictures of errors over seconds, of rows where they have to fall, into ../pictures/extremes
beside it. --weaves runs random_weaves.py instead, JOBS at a time and from number FIRST on.
"""

import argparse
import os
import re
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE] + [os.path.join(HERE, "..", *folder) for folder in ((), ("verification",), ("accuracy",))]

import random_weaves
import rows
from documents import markdown_table, replace_block
from plot import picture
from verify import RunFailed, Runner

HEADER = ["row", "value", "quantity", "verdict", "Newton iterations", "error", "tolerance", "CPU s"]
MARK = "<!-- generated from here on by ./loom extremes -->"
LEAST = 1e-9  # an error below it is drawn as this one
ENDED = {1: "refused", 2: "failed"}  # by status, if the message helps
UNUSABLE = ("wrong", "crashed")


def entries(program):
    """Names of all entries of a scene."""
    text = subprocess.run([program, "--print-parameters"], capture_output=True, text=True, check=True).stdout
    return set(re.findall(r"^\s*set (.+?)\s*=", text, re.MULTILINE))


def verdict_of(failure, names):
    """Of a run that did not end with status 0: it has to say what would help."""
    helps = any(name in failure.message for name in names)
    one_line = failure.message.startswith("fiberloom: ") and "\n" not in failure.message
    return ENDED.get(failure.status, "crashed") if one_line and helps else "crashed"


def sweep(arguments):
    names = entries(arguments.program)
    table, messages, falling = [], [], {}
    for row in arguments.rows or (rows.QUICK if arguments.quick else rows.ROWS):
        runner = Runner(row, arguments)
        for value, judge in rows.ROWS[row](runner):
            lines = []
            try:
                result, checks = judge()
                cost = [f"{result.newton_iterations}", f"{result.cpu_seconds:.1f}"] if result else ["", ""]
                for check in checks:
                    if isinstance(check, rows.Shown):
                        series = falling.setdefault(row, {}).setdefault(f"{check.quantity}, {value.partition(' ')[2]}", [])
                        series.append((seconds_of_mechanics(result), max(abs(check.error()), LEAST)))
                    number = check.shown_error() or f"{check.computed:.4g}"
                    lines.append([row, value, check.quantity, "survived" if check.good() else "wrong", cost[0], number,
                                  check.shown_tolerance(), cost[1]])
            except RunFailed as failure:
                lines.append([row, value, "", verdict_of(failure, names), "", "", "", ""])
                messages.append(f"{row}, {value}: status {failure.status}: {failure.message}")
            except subprocess.TimeoutExpired:
                lines.append([row, value, "no end", "crashed", "", "", "", ""])
            for line in lines:
                print(" | ".join(line), flush=True)
            table += lines
        if arguments.write:  # after each row, so that a sweep can be cut off
            write(arguments.write, table, messages, falling)
    print(*messages, sep="\n")
    counts = {verdict: sum(line[3] == verdict for line in table)
              for verdict in ("survived", *ENDED.values(), *UNUSABLE)}
    print(", ".join(f"{count} {verdict}" for verdict, count in counts.items()))
    return any(counts[verdict] for verdict in UNUSABLE)


def seconds_of_mechanics(result):
    """Without the program's start and output, most of the time of a small scene."""
    return sum(stage["seconds"][part] for stage in result.summary["stages"]
               for part in ("detection", "assembly", "linear_solver"))


def write(file, lines, messages, falling):
    about = "\n".join(f"- **{row}**: {' '.join(rows.ROWS[row].__doc__.split())}"
                      for row in dict.fromkeys(line[0] for line in lines))
    pictures = os.path.join(os.path.dirname(os.path.abspath(file)), "..", "pictures", "extremes")
    os.makedirs(pictures, exist_ok=True)
    for row, series in falling.items():
        with open(os.path.join(pictures, f"{row}.svg"), "w") as drawing:
            drawing.write(picture(row, series, "seconds of detection, assembly and linear solver",
                                  comparable=False))
        about += f"\n\n![{row}: errors over seconds](../pictures/extremes/{row}.svg)"
    said = "\n".join(f"- {message}" for message in messages) or "All survived."
    replace_block(file, f"{about}\n\n{markdown_table(HEADER, lines)}\n\n"
                        f"## What those that were refused or failed said\n\n{said}", MARK)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("rows", nargs="*")
    parser.add_argument("--work", default="extremes")
    parser.add_argument("--write")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--weaves", type=int)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    arguments = parser.parse_intermixed_args()
    arguments.ranks = 1
    os.makedirs(arguments.work, exist_ok=True)
    sys.exit(sweep(arguments) if arguments.weaves is None else 
             random_weaves.weave(arguments, entries(arguments.program), verdict_of))


if __name__ == "__main__":
    main()
