# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""Commands printed in heads of scenes, README.md and doc/ are accepted as they are printed: those that start from a state of another
run after this run has been done with few fibers, all others by `--check`. Only calls of `./loom run` with scenes below prm/."""

import glob
import os
import re
import shlex
import subprocess

from program_runs import PROGRAM, SOURCE, check, finish

COARSE = ["Accuracy=draft", "Fabric/Warp/Fibers per tow=1", "Fabric/Warp/Layers=", "Solver/Error estimate=false", "Output/Pictures=false",
          "Output/Slices=none", "Output/Fields every=0", "Biaxial/First step=1", "Biaxial/Largest step=1"]
PAPER = ["Fabric/Fill/Fibers per tow=1", "Fabric/Fill/Layers=", "Fabric/Warp/Elements per fiber=24"]


def printed(file):
    """Words behind `./loom run` of each command in the file, which may go on over several lines."""
    with open(file) as lines:
        text = re.sub(r"\\\n", " ", lines.read())
    start = r"^# +" if file.endswith(".prm") else r"^    "
    for words in re.findall(start + r"\./loom run (prm/.*)$", text, re.MULTILINE):
        yield shlex.split(re.sub(r"(?<=checkpoint)\. Units.*", "", words), comments=True)


def behind(words, option):
    return words[words.index(option) + 1] if option in words else None


def on_one_rank(words):
    if "--ranks" not in words:
        return words
    i = words.index("--ranks")
    return words[:i] + words[i + 2:]


def coarse(words):
    settings = COARSE + (PAPER if "/paper/" in words[0] else [])
    return words + [word for setting in settings for word in ("--set", setting)]


def call(title, words):
    done = subprocess.run([PROGRAM, *on_one_rank(words)], capture_output=True, text=True)
    check(f"{' '.join(title)}: status {done.returncode} {done.stderr}", done.returncode == 0)


def scene_of(directory):
    """The scene that writes there unless told otherwise."""
    scenes = glob.glob("prm/**/*.prm", recursive=True)
    return next(scene for scene in scenes if re.search(rf"^set Output directory = {directory}$", open(scene).read(), re.MULTILINE))


if not os.path.islink("prm"):
    os.symlink(os.path.join(SOURCE, "prm"), "prm")
files = sorted(glob.glob("prm/**/*.prm", recursive=True))
files += [os.path.join(SOURCE, "README.md"), *sorted(glob.glob(os.path.join(SOURCE, "doc", "*.md")))]
commands = {tuple(words): None for file in files for words in printed(file)}  # each once, in this order
written = set()
starts = [list(words) for words in commands if "--restart" in words]
for words in starts:
    directory = os.path.dirname(behind(words, "--restart"))
    if directory not in written:
        first = next((list(other) for other in commands if behind(other, "--output-directory") == directory), None)
        first = first or [scene_of(directory)]
        call(first, coarse(first))
        written.add(directory)
    call(words, coarse(words) + ["--check"])
for words in map(list, commands):
    if words not in starts and "--set" in words:  # without, it is the scene, which tests of scenes check
        call(words, words + ["--check"])
check(f"{len(commands)} commands, {len(starts)} of them from a state", len(starts) > 10)
finish()
