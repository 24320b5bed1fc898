# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""One fabric by ways that should not matter: steps of weaving, search margins, a restart, ranks.

Forces that differ by more than SAME are those of another equilibrium, with another energy.
"""

import os

from documents import markdown_table

SAME = 1e-3
SCENE = "plain_weave"
PATTERNS = ("plain", "twill 3/1")
STRAINS = (.002, .01, .02)
COMMON = ["Solver/Error estimate=false", "Biaxial/First step=0.1", "Biaxial/Largest step=0.1"]

# way: settings, ranks, whether the pull goes on from the checkpoint of the woven fabric
WAYS = {
    "as it is": ([], 1, False),
    "2 ranks": ([], 2, False),
    "3 ranks": ([], 3, False),
    "restart after `relax`": ([], 1, True),
    "`Contact/Search margin` 0.25": (["Contact/Search margin=0.25"], 1, False),
    "`Contact/Search margin` 0.35": (["Contact/Search margin=0.35"], 1, False),
    "`Weaving/Step` 0.3": (["Weaving/Step=0.3"], 1, False),
    "`Weaving/Step` 0.4": (["Weaving/Step=0.4"], 1, False),
    "`Weaving/Step` 0.6": (["Weaving/Step=0.6"], 1, False),
    "`Weaving/Step` 0.7": (["Weaving/Step=0.7"], 1, False),
}


def pulled(run, settings, ranks, restarted):
    """Energy of the relaxed fabric [N mm], its thickness [mm], warp forces [N] and all Newton iterations."""
    if restarted:
        woven = run(SCENE, settings + ["Stages=weave, relax"], ranks)
        pull = run(SCENE, settings + ["Stages=biaxial"], ranks, os.path.join(woven.directory, "checkpoint"))
    else:
        woven = pull = run(SCENE, settings, ranks)
    relaxed = next(stage for stage in woven.summary["stages"] if stage["name"] == "relax")
    rows = [row for row in pull.rows if row["stage"] == "biaxial"]
    forces = [min(rows, key=lambda row: abs(row["strain_warp"] - strain))["force_warp[N]"] for strain in STRAINS]
    thickness = next(row["thickness[mm]"] for row in reversed(woven.rows) if row["stage"] == "relax")
    iterations = woven.newton_iterations + (pull.newton_iterations if restarted else 0)
    return relaxed["elastic_energy_N_mm"], thickness, forces, iterations


def judge(run):
    header = ["weave", "way", "energy, relaxed [N mm]", "thickness [mm]"]
    header += [f"force at {100 * strain:g} % [N]" for strain in STRAINS] + ["largest difference", "Newton iterations"]
    rows = []
    for pattern in PATTERNS:
        usual = None
        for way, (settings, ranks, restarted) in WAYS.items():
            energy, thickness, forces, iterations = pulled(
                run, COMMON + [f"Fabric/Pattern={pattern}"] + settings, ranks, restarted)
            usual = usual or forces
            off = max(abs(force / one - 1) for force, one in zip(forces, usual))
            rows.append([pattern, way, f"{energy:.6f}", f"{thickness:.5f}", *(f"{force:.4f}" for force in forces),
                         f"{100 * off:.3f} %" + (", another equilibrium" if off > SAME else ""), str(iterations)])
            print(" | ".join(rows[-1]), flush=True)
    return markdown_table(header, rows)
