# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""Restart files and output directories that are no good: status 1, one line, nothing written."""

import math
import os
import shutil
import struct
import subprocess
import sys
import zlib

from program_runs import PROGRAM, SCENES, SMALL_WEAVE, check, finish, run


def check_refusal(what, words, *settings, directory="refused", **options):
    done = run(SMALL_WEAVE, directory, *settings, **options)
    # mpirun adds its own when a rank ends with another status than 0.
    lines = [line for line in done.stderr.splitlines() if "ranks" not in options or line.startswith("fiberloom")]
    check(f"{what}: status {done.returncode}, {lines}",
          done.returncode == 1 and len(lines) == 1 and all(word in lines[0] for word in words))
    check("  nothing written", not os.path.exists(directory))
    shutil.rmtree("refused", ignore_errors=True)


def check_note(what, words, *settings, scene=SMALL_WEAVE):
    """What is accepted, but likely a mistake, is told by --check; nothing if there are no words."""
    words = words if isinstance(words, list) else [words]
    done = subprocess.run([PROGRAM, scene, "--check", *(word for setting in settings for word in ("--set", setting))],
                          capture_output=True, text=True)
    notes = [line for line in done.stdout.splitlines() if line.startswith("note: ")]
    check(f"{what}: status {done.returncode}, {notes}",
          done.returncode == 0 and not done.stderr and len(notes) == (words != []) and
          all(word in notes[0] for word in words))


def check_notes():
    check_note("a usual weave", [])
    check_note("modulus in GPa", ["Warp/Young modulus", "if GPa are meant, it is 73000"], "Fabric/Warp/Young modulus=73")
    check_note("modulus in Pa", "if Pa are meant, it is 73000", "Fabric/Warp/Young modulus=73e9")
    check_note("density", "if kg/m^3 are meant, it is 2.5e-09", "Fabric/Warp/Density=2500")
    check_note("radius in um", "if um are meant, it is 0.008", "Fabric/Warp/Fiber radius=8",
               "Fabric/Warp/Tow spacing=240")
    check_note("twill cut off", ["Fabric/Pattern", "repeats after 4 tows", "mid-period"], "Fabric/Pattern=twill 2/2",
               "Fabric/Warp/Tows=6", "Fabric/Fill/Tows=8")
    check_note("pressed to more than fits", ["Compact/Fiber volume fraction", "about 0.34"], "Fabric/Periodic=true",
               "Stages=weave, compact", "Compact/Fiber volume fraction=0.5", "Fabric/Warp/Tows=2", "Fabric/Warp/Fibers per tow=7",
               "Fabric/Warp/Fiber radius=0.008", "Fabric/Warp/Tow spacing=0.256")
    check_note("set twice", ["--set", "Warp/Tows=2", "the later one counts"], "Fabric/Warp/Tows=4",
               "Fabric/Warp/Tows=2")
    with open(SMALL_WEAVE) as scene, open("twice.prm", "w") as twice:
        twice.write(scene.read() + "set Accuracy = fine\n")
    check_note("set twice in a file", ["line 32: Accuracy is set in line 4, too"], scene="twice.prm")
    with open("extra.csv", "w") as table:
        table.write("fiber,x,y,z,tex\n0,0,0,0,1\n0,1,0,0,1\n")
    with open("extra.prm", "w") as scene:
        scene.write("set Stages = load\nset Drives = d\nsubsection Drive d\nset Ends = 0 start\nend\n"
                    "subsection Fibers\nset File = extra.csv\nend\n")
    check_note("a column that is not read", ["extra.prm, line 7: Fibers/File", "ignored are tex; read are fiber, tow"], scene="extra.prm")


def spoilt(content, place, byte):
    return content[:place] + bytes([byte]) + content[place + 1:]


def rewritten(content, place, text):
    """A checkpoint with `text` at `place` and a checksum that fits."""
    content = content[:place] + text + content[place + len(text):]
    head = content.index(b"\n") + 1 + 16 # behind the format and the size
    return content[:head] + struct.pack("<Q", zlib.crc32(content[head + 8:])) + content[head + 8:]


def main():
    check_notes()
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
    # Sizes, indices and numbers that cannot be, with a checksum that fits.
    q = content.index(struct.pack("<q", 9 * 156)) # a vector of dofs begins with its length
    impossible = {"cannot be read": rewritten(content, q, struct.pack("<q", 1 << 40)),
                  "a position that": rewritten(content, q + 8, struct.pack("<d", math.nan))}
    for words, text in impossible.items():
        with open("bad", "wb") as file:
            file.write(text)
        check_refusal(words, ["bad", words], restart="bad")
    if not os.path.exists("fifo"):
        os.mkfifo("fifo")
    if not os.path.islink("loop"):
        os.symlink("loop", "loop")
    for name in ("fifo", "/dev/zero", "loop"):
        check_refusal(name, [name, "regular" if name != "loop" else "symbolic links"], restart=name)
    check_refusal("missing", ["absent"], restart="absent")
    check_refusal("missing, 2 ranks", ["absent"], restart="absent", ranks=2)

    others = ["Fabric/Pattern=01 10", "Fabric/Warp/Poisson ratio=0.3", "Fabric/Warp/Young modulus=70000",
              "Fabric/Warp/Tow spacing=0.25", "Fabric/Warp/Fibers per tow=2"]
    for setting in others:
        check_refusal(setting, ["another model"], setting, restart=good)
    check_refusal("stage order", ["weave", "Stages"], "Stages=relax, weave", restart=good)

    # Between the samples that are looked at before the run, but at an increment of it.
    done = run(os.path.join(SCENES, "turning_fibers.prm"), "nan", "Load/First step=0.0237", "Load/Largest step=0.0237",
               "Drive upper/Translation=0; 0; -0.01*t + if(abs(t - 0.4029) < 1e-5, 1/0, 0)")
    check(f"not finite at an increment: status {done.returncode}, {done.stderr}",
          done.returncode == 2 and done.stderr.count("\n") == 1 and "Drive upper/Translation is not" in done.stderr)

    open("file", "w").close()
    check_refusal("output below a file", ["file"], directory=os.path.join("file", "below"))
    check_refusal("output in /proc", ["/proc"], directory="/proc/fiberloom")
    finish()


sys.exit(main())
