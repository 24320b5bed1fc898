# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""C3: Peirce's plain weave of rigid round yarns: inclination and crimp, up to the jam.

Reference: closed form, arcs of radius D/2 around the crossing yarns and straight lines between them.
"""

import math

from check import Check

QUICK = False
CURVES = ("{pitch}*(s - 0.5); 0; 0 | "
          "0.96077*sin(2.4*(s - 0.5)); 0.031*(2*i - 1); 0.96077*cos(2.4*(s - 0.5)) - 1")

# pitch over D: inclination [degrees], crimp
REFERENCE = {2: (14.981, .03212), 1.5: (20.797, .05848), 1: (36.870, .14350), .8660254: (60, .2092)}


def judge(run):
    for pitch, (inclination, crimp) in REFERENCE.items():
        result = run("Fibers/Curves=" + CURVES.format(pitch=2 * pitch))
        points = [row for row in result.table("trajectories.csv") if row["kind"] == "fiber" and row["fiber"] == 0]
        # A chord of an arc is half its angle less steep than the tangent at its end.
        chords = [math.atan2(ahead["z[mm]"] - point["z[mm]"], ahead["x[mm]"] - point["x[mm]"])
                  for point, ahead in zip(points, points[1:3])]
        steepest = 1.5 * chords[0] - 0.5 * chords[1]
        length = points[-1]["abscissa[mm]"] - points[0]["abscissa[mm]"]
        what = f"at p/D = {pitch:.3g}, penetration {result.penetration:.3f} r"
        yield Check(f"inclination [degrees] {what}", inclination, math.degrees(steepest), .03)
        yield Check(f"crimp {what}", crimp, length / (points[-1]["x[mm]"] - points[0]["x[mm]"]) - 1, .03)
