# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""An end that turns back is not led through the fiber by the way that the others had.

Each increment draws a fiber of case B10 by more than half an element, the last one half an
elastic slip back: there the law of friction has come from its limit to 3/4 of it.
"""

import os
import sys

from program_runs import SOURCE, check, curve, finish, run

LIMIT = 2 * 3 * .2 * 3e-4  # [N]
WAY = "0.04*min(max(t - 1, 0), 1) - 0.00125*max(t - 2, 0); 0; 0"


def main():
    scene = os.path.join(SOURCE, "prm", "verification", "b10_pull_out.prm")
    done = run(scene, "back", "Fibers/Elements per fiber=96", f"Drive puller/Translation={WAY}", "Load/End=2.2",
               "Load/Largest step=0.2", "Output/Pictures=false")
    check(f"status {done.returncode} {done.stderr}", done.returncode == 0)
    *_, drawn, back = curve("back")
    force = back["force_puller[N]"]
    check(f"drawn by {drawn['force_puller[N]']:.3e} N", abs(drawn["force_puller[N]"] / LIMIT - 1) < .03)
    check(f"a step back, {force:.3e} N", abs(force / (.75 * LIMIT) - 1) < .03)
    check("nothing slips meanwhile", back["dissipation[N.mm]"] == drawn["dissipation[N.mm]"])
    finish()


sys.exit(main())
