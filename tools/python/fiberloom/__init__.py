# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors
"""Runs fiberloom scenes, sweeps their settings and reads what they wrote.

    import fiberloom
    woven = fiberloom.run("prm/plain_weave.prm", {"Stages": "weave, relax"}, output="output/woven")
    study = fiberloom.sweep("prm/plain_weave.prm", {"Contact/Friction coefficient": [.1, .2, .3]},
                            restart=woven.checkpoint, output="output/friction")
    table = fiberloom.table(study)        # one row for each run
    fiberloom.plot(study, "strain_warp", "force_warp[N]")

Units are those of fiberloom: mm, N, MPa.
"""

from .results import Results, table
from .runs import RunFailed, program, run, sweep
from .plots import plot

__all__ = ["Results", "RunFailed", "plot", "program", "run", "sweep", "table"]
__version__ = "0.1.0"
