# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""A4: a steel strip that sags by its own weight and a weight at its tip: an experiment.

Reference: measured by Belendez, Neipp and Belendez, Revista Brasileira de Ensino de Fisica 25 (2003).
"""

from check import Check

QUICK = True

# weight at the tip [N]: sag [mm]
MEASURED = {0: 89, .098: 149, .196: 195, .294: 227, .392: 251, .490: 268, .588: 281}


def judge(run):
    for weight, sag in MEASURED.items():
        yield Check(f"sag [mm] with {weight} N", sag, -run().at("t", 1 + weight / .588)["tip_z[mm]"], .03)
