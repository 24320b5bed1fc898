# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""What ./loom benchmark prints is there, adds up, and changes no result."""

import json
import os
import re
import sys

from program_runs import SMALL_WEAVE, check, check_same, finish, run

LINE = re.compile(r"^(\w+) +(\d+) Newton iterations, (\d+) factorisations; one symmetric double factorisation: "
                  r"([\d.]+) s on (\d) ranks; a Newton iteration: ([\d.]+) of it; detection and assembly: ([\d.]+) %$")


def main():
    few = ["Biaxial/Largest step=0.5", "Biaxial/First step=0.5"]
    run(SMALL_WEAVE, "plain", *few)
    for ranks in (1, 2):
        directory = f"benchmark_{ranks}"
        done = run(SMALL_WEAVE, directory, *few, "Solver/Benchmark=true", ranks=ranks)
        check(f"{ranks} ranks: status {done.returncode}", done.returncode == 0)
        with open(os.path.join(directory, "summary.json")) as file:
            stages = {stage["name"]: stage for stage in json.load(file)["stages"]}
        with open(os.path.join(directory, "log.txt")) as file:
            found = [match.groups() for match in map(LINE.match, file.read().splitlines()) if match]
        check("  a line for each stage that solves", [line[0] for line in found] ==
              [name for name, stage in stages.items() if stage["newton_iterations"] > 0])
        for name, iterations, factorizations, yardstick, on, ratio, share in found:
            stage = stages[name]
            seconds, wall = stage["seconds"], stage["wall_seconds"]
            parts = seconds["analysis"] + seconds["factorization"] + seconds["krylov"]
            front = seconds["detection"] + seconds["assembly"]
            work = front + seconds["linear_solver"]
            check(f"  {name}: {iterations} Newton iterations, {factorizations} factorisations on {on} ranks",
                  [int(iterations), int(factorizations), int(on)] ==
                  [stage["newton_iterations"], stage["factorizations"], ranks])
            check(f"    linear solver {seconds['linear_solver']:.3f} s, its parts {parts:.3f} s",
                  0 < parts <= 1.001 * seconds["linear_solver"])
            check(f"    detection, assembly and linear solver {work:.3f} s of {wall:.3f} s", work <= 1.001 * wall)
            check(f"    detection and assembly {share} %", abs(float(share) - 100 * front / work) < .06)
            # Of matrices this small a factorisation takes some hundredths of a second: printed with two digits.
            check(f"    an iteration is {ratio} of {yardstick} s",
                  abs(float(ratio) * float(yardstick) - work / int(iterations)) < .006 * (float(ratio) + 1))
        check_same("  curve", "plain", directory, 1e-4 if ranks > 1 else 1e-12)
    finish()


sys.exit(main())
