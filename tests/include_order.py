# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""A folder includes only itself and the folders before it, and each library
is seen only where it belongs. Usage: include_order.py ROOT

First it is tried on a made-up tree with one violation of each kind.
"""

import pathlib
import re
import sys
import tempfile

FOLDERS = ("base fabric beams matrix contact coupling model solvers stages output simulation").split()

# Library, what its includes look like, and the folders or files that may see it.
LIBRARIES = [
    ("CGAL", r"CGAL/", {"contact"}),
    ("VTK", r"vtk\w*\.h(xx)?$", {"output", "source/fabric/vtk_arrays.cc"}),
    ("MPI and Trilinos", r"(mpi\.h$|Epetra|Teuchos|Amesos|AztecOO|Belos|ml_|deal\.II/(base/mpi|lac/trilinos|distributed/))",
     set(FOLDERS) - {"fabric", "beams", "matrix", "coupling"}),
]

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]')


def complaint(folder, file, header):
    """What is wrong with this include in this file of this folder; None if nothing is."""
    own = re.match(r"fiberloom/(\w+)/", header)
    if own and own[1] not in FOLDERS:
        return f"{own[1]}/ is not one of the folders"
    if own and FOLDERS.index(own[1]) > FOLDERS.index(folder):
        return f"{folder}/ comes before {own[1]}/"
    for library, pattern, allowed in LIBRARIES:
        if re.match(pattern, header) and not allowed & {folder, file}:
            return f"{library} is not for {folder}/"
    return None


def violations(root):
    """One line for each wrong include, and the number of includes read."""
    found, n_includes = [], 0
    for top in ("include/fiberloom", "source"):
        for file in sorted((root / top).glob("*/**/*")):
            if file.suffix not in (".h", ".cc"):
                continue
            folder = file.relative_to(root / top).parts[0]
            if folder not in FOLDERS:
                found.append(f"{file.relative_to(root)}: {folder}/ is not one of the folders")
                continue
            for number, line in enumerate(file.read_text().splitlines(), 1):
                match = INCLUDE.match(line)
                n_includes += bool(match)
                text = match and complaint(folder, file.relative_to(root).as_posix(), match[1])
                if text:
                    found.append(f"{file.relative_to(root)}:{number}: {match[1]}: {text}")
    return found, n_includes


def try_on_violations():
    wrong = {
        "include/fiberloom/fabric/a.h": "<fiberloom/beams/fiber_mesh.h>",
        "include/fiberloom/beams/b.h": "<deal.II/base/mpi.h>",
        "source/beams/c.cc": "<deal.II/lac/trilinos_sparse_matrix.h>",
        "source/coupling/d.cc": "<mpi.h>",
        "source/model/e.cc": '"fiberloom/solvers/newton.h"',
        "source/output/f.cc": "<CGAL/AABB_tree.h>",
        "source/stages/g.cc": "<vtkPoints.h>",
        "source/fabric/fibers.cc": "<vtkPoints.h>",
        "source/utilities/h.cc": "<vector>",
        "source/base/i.cc": "<fiberloom/misc/i.h>",
    }
    right = {
        "source/contact/j.cc": "<CGAL/AABB_tree.h>",
        "source/output/k.cc": "<vtkPoints.h>",
        "source/fabric/vtk_arrays.cc": "<vtkPoints.h>",
        "source/model/l.cc": "<deal.II/lac/trilinos_sparse_matrix.h>",
        "source/stages/m.cc": "<fiberloom/base/exceptions.h>",
    }
    with tempfile.TemporaryDirectory() as directory:
        root = pathlib.Path(directory)
        for name, header in (wrong | right).items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(f"#include {header}\n")
        blamed = sorted(line.split(":")[0] for line in violations(root)[0])
    if blamed != sorted(wrong):
        sys.exit(f"The check itself is wrong: it blames {blamed} of {sorted(wrong)}.")


try_on_violations()
found, n_includes = violations(pathlib.Path(sys.argv[1]))
print(*found, f"{n_includes} includes read, {len(found)} wrong", sep="\n")
sys.exit(1 if found or n_includes == 0 else 0)
