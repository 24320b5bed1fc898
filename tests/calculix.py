# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""A filled cell as a deck of voxels, solved by CalculiX with periodic borders: as stiff along warp and fill as stage `stiffness` says.

    calculix.py PROGRAM SOURCE_DIRECTORY

Shear is not compared: it does not reach the fibers of the program's own model.
"""

import json
import os
import shutil
import subprocess
import sys

from program_runs import SCENES, check, finish, run

CELL = os.path.join(SCENES, "small_cell.prm")
# As high as the five voxels that hold the fabric.
FILLED = ["Stages=weave, relax, coat, stiffness", "Matrix/Layers=filled", "Matrix/Young modulus=3000",
          "Matrix/Thickness=0.003866", "Output/Export=abaqus"]
STRAIN, TOLERANCE, SKIPPED = 1e-3, .05, 77


class Deck:
    """One of voxels whose borders are tied, with the mean strain on two more nodes."""

    def __init__(self, file):
        with open(file) as lines:
            self.text = lines.read().split("*STEP")[0]
        nodes, rows = {}, iter(self.text.split("*NODE")[1].splitlines()[1:])
        for row in rows:
            if row.startswith("*"):
                break
            number, *place = row.split(",")
            nodes[int(number)] = tuple(round(1e6 * float(x)) for x in place[:3])
        self.low, self.high = (tuple(extreme(axis) for axis in zip(*nodes.values())) for extreme in (min, max))
        self.size = [1e-6 * (b - a) for a, b in zip(self.low, self.high)]
        self.strained = [max(nodes) + 1, max(nodes) + 2]
        self.text += "*NODE, NSET=STRAINED\n" + "".join(f"{n}, 0, 0, 0\n" for n in self.strained)
        numbers = {place: number for number, place in nodes.items()}
        for number, place in nodes.items():
            ends = [axis for axis in (0, 1) if place[axis] == self.high[axis]]
            start = numbers[tuple(self.low[axis] if axis in ends else place[axis] for axis in range(3))]
            for dof in (1, 2, 3) if ends else ():
                terms = [(number, dof, 1), (start, dof, -1)] + [(self.strained[axis], dof, -1) for axis in ends]
                self.text += f"*EQUATION\n{len(terms)}\n{', '.join(f'{n}, {d}, {c}' for n, d, c in terms)}\n"
        self.text += f"*BOUNDARY\n{numbers[self.low]}, 1, 3\n"

    def energy(self, *strains):
        """Of the cell [N mm], by strains along warp and fill."""
        moves = "".join(f"{node}, {dof}, {dof}, {strains[axis] * self.size[axis] if dof == axis + 1 else 0:.12g}\n"
                        for axis, node in enumerate(self.strained) for dof in (1, 2, 3))
        with open("cell.inp", "w") as file:
            file.write(f"{self.text}*STEP\n*STATIC\n*BOUNDARY\n{moves}*EL PRINT, ELSET=ALL_ELEMENTS, TOTALS=ONLY\nELSE\n*END STEP\n")
        subprocess.run(["ccx", "cell"], capture_output=True, check=True)
        with open("cell.dat") as file:
            return float(file.read().split()[-1])


def main():
    if shutil.which("ccx") is None:
        sys.exit(SKIPPED)
    done = run(CELL, "cell", *FILLED)
    check(f"filled cell: status {done.returncode} {done.stderr}", done.returncode == 0)
    with open(os.path.join("cell", "summary.json")) as file:
        own = json.load(file)["stages"][-1]["engineering_constants"]
    deck = Deck(os.path.join("cell", "export", "voxels.inp"))
    check(f"as high as the matrix: {deck.size[2]}", abs(deck.size[2] / own["thickness_mm"] - 1) < .005)
    scale = 2 / (deck.size[0] * deck.size[1] * deck.size[2] * STRAIN ** 2)
    warp, fill, both = (scale * deck.energy(*strains) for strains in ((STRAIN, 0), (0, STRAIN), (STRAIN, STRAIN)))
    coupling = (both - warp - fill) / 2
    for name, modulus in (("warp", warp - coupling ** 2 / fill), ("fill", fill - coupling ** 2 / warp)):
        ours = own[f"young_modulus_{name}_MPa"]
        check(f"modulus along {name}: {ours:.0f} MPa, by CalculiX {modulus:.0f}", abs(ours / modulus - 1) < TOLERANCE)
    finish()


sys.exit(main())
