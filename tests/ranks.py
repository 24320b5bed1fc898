# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""Any number of ranks gives the same loading curve."""

import os
import sys

from program_runs import SMALL_WEAVE, SOURCE, check, check_same, finish, run


def main():
    cantilever = os.path.join(SOURCE, "prm", "cantilever.prm")
    few = ["Biaxial/Largest step=0.5", "Biaxial/First step=0.5", "Load/Largest step=0.25"]
    for name, scene, tolerance in (("weave", SMALL_WEAVE, 1e-4), ("cantilever", cantilever, 1e-8)):
        for ranks in (1, 2, 3):
            done = run(scene, f"{name}_{ranks}", *few, ranks=ranks)
            check(f"{name} on {ranks} ranks: status {done.returncode}", done.returncode == 0)
            if ranks > 1:
                check_same("  curve", f"{name}_1", f"{name}_{ranks}", tolerance)
    finish()


sys.exit(main())
