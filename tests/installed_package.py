#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors
"""What `cmake --install` puts into a tree runs there, and another program builds with it."""

import json
import shutil
import subprocess
import sys
from pathlib import Path

program, source = Path(sys.argv[1]), Path(sys.argv[2])
work = Path.cwd()


def run(*command):
    """Returns what @p command prints; ends the test where it fails."""
    result = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if result.returncode:
        print(result.stdout[-2000:], result.stderr[-2000:], sep="\n")
        sys.exit(f"{command[0]} {command[1]}: status {result.returncode}")
    return result.stdout


for old in ("prefix", "build", "out"):
    shutil.rmtree(work / old, ignore_errors=True)
run("cmake", "--install", program.parent, "--prefix", work / "prefix")
scene = work / "prefix/share/fiberloom/prm/plain_weave.prm"
installed = work / "prefix/bin/fiberloom"
print(run(installed, "--version").splitlines()[0])
run(installed, scene, "--set", "Stages=weave", "--set", "Fabric/Warp/Tows=2", "--set", "Fabric/Fill/Same as warp=true",
    "--set", "Fabric/Warp/Fibers per tow=3", "--output-directory", work / "out")
summary = json.loads((work / "out/summary.json").read_text())
if not summary["converged"]:
    sys.exit("the installed program does not converge")

run("cmake", "-S", source / "tests/package", "-B", work / "build", f"-DCMAKE_PREFIX_PATH={work / 'prefix'}",
    "-DCMAKE_BUILD_TYPE=Release")
run("cmake", "--build", work / "build")
counted = run(work / "build/count_fibers", scene).strip()
if counted != "56 fibers, 2744 nodes":
    sys.exit(f"the program that links to the library counts {counted}")
print(f"installed, built with and run: {counted}")
