# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""Restart files and output directories that are no good: status 1, one line, nothing written."""

import os
import shutil
import sys

from program_runs import SMALL_WEAVE, check, finish, run


def check_refusal(what, words, *settings, directory="refused", **options):
    done = run(SMALL_WEAVE, directory, *settings, **options)
    # mpirun adds its own when a rank ends with another status than 0.
    lines = [line for line in done.stderr.splitlines() if "ranks" not in options or line.startswith("fiberloom")]
    check(f"{what}: status {done.returncode}, {lines}",
          done.returncode == 1 and len(lines) == 1 and all(word in lines[0] for word in words))
    check("  nothing written", not os.path.exists(directory))
    shutil.rmtree("refused", ignore_errors=True)


def spoilt(content, place, byte):
    return content[:place] + bytes([byte]) + content[place + 1:]


def main():
    check("woven", run(SMALL_WEAVE, "woven", "Stages=weave").returncode == 0)
    good = os.path.join("woven", "checkpoint")
    with open(good, "rb") as file:
        content = file.read()
    version = content.index(b"\n") + 1
    damaged = {"truncated": content[:-100], "format": spoilt(content, version, 99),
               "damaged": spoilt(content, len(content) // 2, content[len(content) // 2] ^ 1),
               "not a checkpoint": b"set Stages = relax\n"}
    for words, text in damaged.items():
        with open("bad", "wb") as file:
            file.write(text)
        check_refusal(words, ["bad", words], restart="bad")
    check_refusal("missing", ["absent"], restart="absent")
    check_refusal("missing, 2 ranks", ["absent"], restart="absent", ranks=2)

    others = ["Fabric/Pattern=01 10", "Fabric/Warp/Poisson ratio=0.3", "Fabric/Warp/Young modulus=70000",
              "Fabric/Warp/Tow spacing=0.25", "Fabric/Warp/Fibers per tow=2"]
    for setting in others:
        check_refusal(setting, ["another model"], setting, restart=good)
    check_refusal("stage order", ["weave", "Stages"], "Stages=relax, weave", restart=good)

    open("file", "w").close()
    check_refusal("output below a file", ["file"], directory=os.path.join("file", "below"))
    check_refusal("output in /proc", ["/proc"], directory="/proc/fiberloom")
    finish()


sys.exit(main())
