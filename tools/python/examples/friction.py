#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors
"""How much friction stiffens a plain weave: one weave, pulled with ten friction coefficients.

    PYTHONPATH=tools/python python3 tools/python/examples/friction.py
"""

import fiberloom

# %% Woven once: how a fabric rests does not depend on friction.
woven = fiberloom.run("prm/plain_weave.prm", {"Stages": "weave, relax"}, output="output/friction/woven")
print(f"{woven.fabric['thickness[mm]']:.4f} mm thick, crimp {woven.fabric['crimp_warp']:.4f}")

# %% Pulled ten times, from the same state.
coefficients = [round(.05 * (k + 1), 2) for k in range(10)]
study = fiberloom.sweep("prm/plain_weave.prm", {"Contact/Friction coefficient": coefficients}, restart=woven.checkpoint,
                        output="output/friction", settings={"Output/Pictures": False})

# %% As a table and as curves.
table = fiberloom.table(study)
print(table[["Contact/Friction coefficient", "force_warp[N]", "force_fill[N]", "converged"]].to_string(index=False))
axes = fiberloom.plot(study, "strain_warp", "force_warp[N]")
axes.figure.savefig("output/friction/forces.svg")
