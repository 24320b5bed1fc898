# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""Accuracy = preview: woven in order by coarse fibers, without other stages, and each file says so.

    preview.py PROGRAM SOURCE_DIRECTORY
"""

import csv
import json
import os

from program_runs import SMALL_WEAVE, SOURCE, check, finish, run

PREVIEW = "Accuracy=preview"

for ranks in (1, 2):
    directory = f"weave_{ranks}"
    done = run(SMALL_WEAVE, directory, PREVIEW, "Fabric/Warp/Elements per fiber=40", "Output/Pictures=true",
               "Output/Fields every=1", "Output/Slices=both", ranks=ranks)
    check(f"{ranks} ranks: status {done.returncode} {done.stderr}", done.returncode == 0)
    with open(os.path.join(directory, "summary.json")) as file:
        summary = json.load(file)
    check("summary: a preview", summary["preview"] is True)
    check("summary: nothing has converged",
          not summary["converged"] and not any(stage["converged"] for stage in summary["stages"]))
    check("weave is the only stage", [stage["name"] for stage in summary["stages"]] == ["weave"])
    check("in order", summary["stages"][0]["crossings_out_of_order"] == 0)
    model = summary["model"]
    check("two elements for each of two tows", model["fiber_elements"] == 4 * model["fibers"])
    for table in ("loading_curve.csv", "fabric.csv"):
        with open(os.path.join(directory, table)) as file:
            rows = list(csv.DictReader(file))
        check(f"{table}: a preview", rows and all("preview" in row["stage"] for row in rows))
    for file in ("report.html", "log.txt"):
        with open(os.path.join(directory, file)) as text:
            check(f"{file}: a preview", "nothing is claimed of" in text.read())
    check("nothing to go on from", not os.path.exists(os.path.join(directory, "checkpoint")))
    shown = [file for folder in ("fields", "pictures", "slices")
             for file in os.listdir(os.path.join(directory, folder))]
    check("files to look at", shown and all("preview" in file for file in shown))

done = run(os.path.join(SOURCE, "prm", "cantilever.prm"), "cantilever", PREVIEW)
check(f"without a weave: status {done.returncode} {done.stderr}",
      done.returncode == 1 and len(done.stderr.strip().splitlines()) == 1 and "Stages" in done.stderr)
finish()
