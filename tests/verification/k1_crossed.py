# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""K1: two crossed glass fibers, ends clamped, pressed together by 60 micrometers.

Reference: extensible rods with shear (k = 0.9) by a boundary value problem of the half span, ref_bvp.py.
"""

from check import Check, Report

QUICK = True
FORCE = 5.534756e-3
PULL = 3.0001e-2  # along the fiber, at each clamp


def judge(run):
    result = run()
    yield Report("CPU seconds", result.cpu_seconds, "DisMech .10-.18, Yade 2.4")
    yield Check(f"crossing force [N], penetration {result.penetration:.4f} r", FORCE, result.last["force_upper[N]"], 1e-2)
    yield Check("pull along the fibers [N]", PULL, result.last["lower_end_force_x[N]"], 1e-2)
