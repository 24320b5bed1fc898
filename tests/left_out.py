# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""What a scene does not need is not built: counts and seconds of scenes without and with it.

    left_out.py PROGRAM SOURCE_DIRECTORY [--write]

`--write` puts the table into doc/results/performance.md.
"""

import json
import os
import sys

from documents import block, markdown_table, replace_block
from program_runs import SMALL_WEAVE, SOURCE, check, finish, run

DOCUMENT = os.path.join(SOURCE, "doc", "results", "performance.md")
BEGIN, END = "<!-- left out: begin -->", "<!-- left out: end -->"
HEADER = ["scene", "what it does without", "count", "seconds", "beside it", "count", "seconds"]

CANTILEVER, CROSSED, ROLLED = (os.path.join(SOURCE, "prm", *name) for name in
                               (["cantilever.prm"], ["crossed_fibers.prm"], ["verification", "a1_roll_up.prm"]))
SEARCHING = "Contact/Self contact=automatic"  # which is to search where a fiber can meet itself
APART = ["Fibers/Polylines=-0.5 0 0, 0.5 0 0; 0 -0.5 0.1, 0 0.5 0.1", "Load/End=0.1"]
MATRIX = ["Matrix/Layers=both", "Matrix/Cells along x=3", "Matrix/Cells along y=3", "Stages=weave, relax, coat, biaxial"]
SHORT = ["Biaxial/Largest step=0.5", "Biaxial/First step=0.5"]
DRAWING = ["Output/Slices=both", "Output/Fields every=1"]


def n_files(directory):
    return sum(len(files) for _, _, files in os.walk(directory))


class Run:
    """Counts and seconds of a run, over all its stages."""

    def __init__(self, name, scene, *settings, ranks=1):
        self.directory = name
        done = run(scene, name, "Solver/Error estimate=false", *settings, ranks=ranks)
        check(f"{name}: status {done.returncode} {done.stderr}", done.returncode == 0)
        with open(os.path.join(name, "summary.json")) as file:
            self.summary = json.load(file)
        with open(os.path.join(name, "log.txt")) as file:
            self.log = file.read()

    def count(self, what):
        if what == "files":
            return n_files(self.directory)
        if what in self.summary["model"]:
            return self.summary["model"][what]
        counts = [stage[what] for stage in self.summary["stages"]]
        return max(counts) if what in ("friction_history", "exchanged_values") else sum(counts)

    def seconds(self, part):
        return sum(stage["seconds"][part] for stage in self.summary["stages"])


def table_row(without, what, part, beside, least=0, named=None):
    """Of a scene that is to have `least` of `what`, beside one that has more."""
    few, many = without.count(what), beside.count(what)
    check(f"{without.directory}: {what} {few}, of {beside.directory} {many}", few == least < many)
    if named:
        check(f"  the log says: {named}", named in without.log and named not in beside.log)
    shown = [f"{run.seconds(part):.3f} {part.replace('_', ' ')}" for run in (without, beside)]
    return [without.directory.replace("_", " "), what.replace("_", " "), str(few), shown[0],
            beside.directory.replace("_", " "), str(many), shown[1]]


def rows():
    fiber = Run("single_fiber", CANTILEVER, SEARCHING)
    crossed = Run("crossed_fibers", CROSSED, SEARCHING)
    apart = Run("two_fibers_apart", CROSSED, SEARCHING, *APART)
    for run in (fiber, apart):
        yield table_row(run, "searches", "detection", crossed)
    yield table_row(fiber, "contact_elements", "detection", crossed)

    rubbing = Run("with_friction", SMALL_WEAVE, *SHORT)
    smooth = Run("frictionless", SMALL_WEAVE, *SHORT, "Contact/Friction coefficient=0")
    moment = Run("moment_on_a_free_end", ROLLED, "Load/End=0.0625")
    yield table_row(smooth, "friction_history", "assembly", rubbing, named="friction and its history")
    for run in (smooth, rubbing):
        yield table_row(run, "unsymmetric_systems", "krylov", moment)

    filled = Run("in_a_matrix", SMALL_WEAVE, *SHORT, *MATRIX)
    for what in ("matrix_cells", "matrix_dofs", "junctions"):
        yield table_row(rubbing, what, "assembly", filled, named="matrix layers, junctions")

    two_ranks = Run("two_ranks", SMALL_WEAVE, *SHORT, ranks=2)
    yield table_row(rubbing, "exchanged_values", "krylov", two_ranks)

    silent = Run("no_output", SMALL_WEAVE, *SHORT, "Output/Only summary=true")
    drawing = Run("all_output", SMALL_WEAVE, *SHORT, *DRAWING)
    check("  two files, no folder", sorted(os.listdir(silent.directory)) == ["log.txt", "summary.json"])
    yield table_row(silent, "files", "output", drawing, least=2, named="all files but log.txt and summary.json")
    check("  same iterations", silent.count("newton_iterations") == drawing.count("newton_iterations"))


def check_document(found):
    """The rows that stand there; seconds may differ."""
    lines = block(DOCUMENT, BEGIN, END)[1].strip().splitlines()[2:]
    written = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    check("doc/results/performance.md has these scenes and what they do without",
          [row[:3] for row in written] == [row[:3] for row in found])


def main():
    found = list(rows())
    if "--write" in sys.argv:
        replace_block(DOCUMENT, markdown_table(HEADER, found), BEGIN, END)
    check_document(found)
    finish()


sys.exit(main())
