# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""Newton's method on one potential finds the forces of the three nested loops."""

import os
import sys

from program_runs import SMALL_WEAVE, SOURCE, check, curve, finish, run

K3 = os.path.join(SOURCE, "prm", "verification", "k3_plain_weave_4x4.prm")
ALLOWED = 5e-4  # of the largest force: in the nested loops points and normals stand still while forces are found


def forces(name, scene, *settings, **options):
    process = run(scene, name, "Solver/Error estimate=false", "Solver/Contact tolerance=1e-5", *settings, **options)
    check(f"{name}: status {process.returncode} {process.stderr}", process.returncode == 0)
    rows = curve(name)
    return [row[column] for row in rows for column in row if column.startswith("force_") and column.endswith("[N]")]


def compare(name, scene, *settings, **options):
    newton, nested = (forces(f"{name}_{loops}", scene, f"Solver/Loops={loops}", *settings, **options)
                      for loops in ("newton", "nested"))
    largest = max(map(abs, newton))
    off = max(abs(a - b) for a, b in zip(newton, nested)) / largest
    check(f"{name}: {len(newton)} forces up to {largest} N, {off:.1e} apart",
          largest > .1 and len(newton) == len(nested) and 0 < off < ALLOWED)


def main():
    # What stands still differs by the angles between elements: 5.9e-4 with 16, 4.4e-4 with 24, 3.7e-4 with 32.
    compare("crossed", K3, "Fibers/Elements per fiber=24")
    run(SMALL_WEAVE, "woven", "Stages=weave, relax")
    compare("pulled", SMALL_WEAVE, "Stages=biaxial", restart=os.path.join("woven", "checkpoint"))
    finish()


sys.exit(main())
