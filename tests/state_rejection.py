# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""A run whose increment is rejected and cut equals one that takes the small increment at once."""

import json
import os
import sys

from program_runs import SMALL_WEAVE, check, check_same, curve, finish, run

# Iterations that move fibers so little are too few for a large step.
SETTINGS = ["Biaxial/Largest strain=0.03", "Biaxial/Largest step=1", "Solver/Growth=1",
            "Solver/Largest Newton iterations=8", "Solver/Largest move=0.01",
            "Solver/Largest loop iterations=10"]


def rejected(directory):
    with open(os.path.join(directory, "summary.json")) as file:
        return json.load(file)["stages"][-1]["rejected_increments"]


def main():
    check("woven", run(SMALL_WEAVE, "woven", "Stages=weave, relax").returncode == 0)
    for directory in ("large", "small"):
        step = 1 if directory == "large" else curve("large")[1]["load"]
        settings = ["Stages=biaxial", f"Biaxial/First step={step}", *SETTINGS]
        done = run(SMALL_WEAVE, directory, *settings, restart=os.path.join("woven", "checkpoint"))
        check(f"first step {step}: status {done.returncode} {done.stderr}", done.returncode == 0)
    # Increments after the first accepted one may be rejected in both alike.
    counts = rejected("large"), rejected("small")
    check(f"increments were rejected: {counts[0]}, and less with the small step: {counts[1]}", counts[0] > counts[1])
    check_same("curve", "large", "small", 1e-10)
    finish()


sys.exit(main())
