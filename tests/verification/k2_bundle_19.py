# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""K2: hexagonal bundle of 19 glass fibers, clamped rigidly, turned by half a turn at fixed length.

Reference: as for 7 fibers.
"""

from k2_bundle_7 import judge_bundle

QUICK = False


def judge(run):
    yield from judge_bundle(run, 19, .9395, 1.439e-2, "DisMech 54, Yade 21")
