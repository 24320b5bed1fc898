# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""What a small set of scenes costs, in units of a fixed computation that is run beside them.

    speed.py PROGRAM REFERENCE [--rounds N] [--work DIRECTORY] [--write FILE]

Each round runs REFERENCE before and after every scene, on one rank; a scene's cost is its CPU seconds
over the mean of those two. Prints the median of all rounds, its range, and the same for detection,
assembly and linear solver; beside it what doc/results/performance.md holds, and "slower" or "faster" where the
ranges of then and now lie apart. --write puts the table into the block of a document. The status tells
nothing about speed: machines are noisy, so a person looks.
"""

import argparse
import os
import re
import statistics
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, ".."), os.path.join(HERE, "..", "verification")]

from documents import block, markdown_table, replace_block
from verify import Runner, cpu_of_children

DOCUMENT = os.path.join(HERE, "..", "..", "doc", "results", "performance.md")
BEGIN, END = "<!-- speed: by ./loom speed -->", "<!-- end of speed -->"
HEADER = ["scene", "Newton iterations", "all (range)", "detection", "assembly", "linear solver"]
PARTS = ("detection", "assembly", "linear_solver")
QUIET = ("Output/Pictures=false", "Output/Fields every=0", "Output/Slices=none")

# name: scene, settings; each some seconds long
SCENES = {
    "A3, 64 elements": ("a3_bend_45", "Fibers/Elements per fiber=64"),
    "B1, two beams twisted": ("b1_rope",),
    "K2, 19 fibers twisted": ("k2_bundle_19",),
    "K3, 4 by 4 fibers woven": ("k3_plain_weave_4x4", "Fibers/Elements per fiber=48"),
    "4 by 4 tows woven": ("../plain_weave", "Stages=weave"),
    "in a matrix": ("../plain_composite_biaxial", "Biaxial/Largest step=0.5", "Biaxial/First step=0.5"),
}


def seconds_of(program):
    before = cpu_of_children()
    subprocess.run([program], check=True)
    return cpu_of_children() - before


def measure(arguments):
    """For each scene its Newton iterations and its costs in each round: all, then parts."""
    found = {name: (None, []) for name in SCENES}
    last = seconds_of(arguments.reference)
    for turn in range(arguments.rounds):
        for name, (scene, *settings) in SCENES.items():
            runner = Runner(f"speed_{turn}", arguments)
            result = runner(*QUIET, *settings, scene=scene)
            before, last = last, seconds_of(arguments.reference)
            unit = (before + last) / 2
            seconds = [result.cpu_seconds] + [sum(stage["seconds"][part] for stage in result.summary["stages"])
                                              for part in PARTS]
            found[name] = result.newton_iterations, found[name][1] + [[second / unit for second in seconds]]
    return found


def recorded(document):
    """Ranges of the document's table by scene."""
    ranges = {}
    for line in block(document, BEGIN, END)[1].splitlines():
        match = re.match(r"\| ([^|]+) \| \d+ \| [\d.]+ \(([\d.]+) to ([\d.]+)\)", line)
        if match:
            ranges[match[1]] = float(match[2]), float(match[3])
    return ranges


def verdict(least, most, then):
    if not then:
        return "not recorded"
    compared = "slower" if least > then[1] else "faster" if most < then[0] else "as fast"
    return f"recorded {then[0]:.2f} to {then[1]:.2f}: {compared}"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("reference")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--work", default="speed")
    parser.add_argument("--write", help="a document to be written to, and compared with before")
    arguments = parser.parse_args()
    arguments.ranks = 1
    document = arguments.write or DOCUMENT
    before = recorded(document)
    rows = []
    for name, (iterations, rounds) in measure(arguments).items():
        middle = [statistics.median(column) for column in zip(*rounds)]
        least, most = min(costs[0] for costs in rounds), max(costs[0] for costs in rounds)
        rows.append([name, str(iterations), f"{middle[0]:.2f} ({least:.2f} to {most:.2f})"] +
                    [f"{part:.2f}" for part in middle[1:]])
        print(" | ".join(rows[-1] + [verdict(least, most, before.get(name))]), flush=True)
    if arguments.write:
        replace_block(document, markdown_table(HEADER, rows), BEGIN, END)


if __name__ == "__main__":
    main()
