# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""C4: shear locking of a woven composite, at the angle where neighboring tows lie side by side.

Reference: cos(angle) = w/p with the width w and the pitch p of the thick tows as woven, both read from the relaxed fabric.
The computed angle is that at which the tangent at the end of the curve of the moment meets that at its start.
"""

import math

from check import Bound, Check

QUICK = True


def mean(values):
    values = list(values)
    return sum(values) / len(values)


def woven(run):
    """Width and pitch of the two thick tows [mm]."""
    sections = [row for row in run("Stages=weave, relax").table("trajectories.csv")
                if row["kind"] == "tow" and row["family"] == "warp"]
    first, second = (mean(row["y[mm]"] for row in sections if row["tow"] == tow) for tow in (0, 1))
    return mean(row["width[mm]"] for row in sections), second - first


def judge(run):
    width, pitch = woven(run)
    locking = math.acos(width / pitch)
    result = run()
    rows = [row for row in result.rows if row["stage"] == "shear"]
    angle, moment = ([row[name] for row in rows] for name in ("shear_angle[rad]", "shear_moment[N.mm]"))
    slope = [(after - before) / (b - a) for before, after, a, b in zip(moment, moment[1:], angle, angle[1:])]
    meeting = (slope[-1] * angle[-1] - moment[-1]) / (slope[-1] - slope[0])
    what = f"w/p = {width:.4g}/{pitch:.4g}, penetration {result.penetration:.3f} r"
    yield Check(f"locking angle [rad], {what}", locking, meeting, .1)
    yield Check("angle at which neighboring tows press on each other [rad]", locking,
                next(row["shear_angle[rad]"] for row in rows if row["neighbor_force[N]"] > 0), .1)
    free = max(s for s, a in zip(slope, angle[1:]) if a < .9 * locking)
    yield Bound("tangent at the end over the steepest below 0.9 of that angle", slope[-1] / free, least=2)
    yield Bound("angle at the end [rad]", angle[-1], least=.6)
