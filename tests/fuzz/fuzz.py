# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""Damaged input: each file is accepted, or refused in one line with nothing written.

    fuzz.py FORK_SERVER SOURCE_DIRECTORY [--of scenes|fibers|checkpoints] [--files N] [--seed S] [--first I]

Changes copies of files in a few places and lets the program check them within
limits of time and memory: scenes, files of fibers, or checkpoints, whose checksums
are made to fit. Every tenth, of checkpoints one that is accepted, else one that is
refused, goes through the program a second time without --check. Allowed are status 0,
and status 1 with one line on stderr, both without a trace in the working directory; a
run from a damaged checkpoint may also stop with status 2. Everything else is a
finding: its file is kept in `findings/` and named. File number I of a seed is always
the same: `--first I --files 1` makes it again.
"""

import argparse
import collections
import os
import pathlib
import random
import shutil
import subprocess
import sys
import time

from damaged_checkpoints import Checkpoints
from damaged_fibers import Fibers
from damaged_scenes import Scenes

# The largest scene takes 2 s and 0.5 GB.
SECONDS, MEGABYTES = 60, 4000
KINDS = {"scenes": Scenes, "fibers": Fibers, "checkpoints": Checkpoints}


class Program:
    """Runs the program in `work/here`, which has to stay empty."""

    def __init__(self, server, work):
        self.work = work
        self.here = work / "here"
        self.here.mkdir()
        self.command = [server, str(SECONDS), str(MEGABYTES)]
        self.start()

    def start(self):
        self.server = subprocess.Popen(self.command, cwd=self.here, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def answer(self, line):
        """How the child ended; if the server itself did, how that ended, and there is a new one."""
        try:
            self.server.stdin.write(line + "\n")
            self.server.stdin.flush()
        except BrokenPipeError:
            pass
        ended = self.server.stdout.readline().strip()
        if not ended:
            ended = f"the fork server is gone with status {self.server.wait()}"
            self.start()
        return ended

    def run(self, *arguments, allowed=("exit 0", "exit 1")):
        """(what is wrong or "", status)."""
        (self.work / "err").write_bytes(b"")
        ended = self.answer("\t".join(arguments))
        error = (self.work / "err").read_bytes()
        written = list(self.here.iterdir())
        for path in written:
            shutil.rmtree(path) if path.is_dir() else path.unlink()
        wrong = ""
        if ended not in allowed:
            wrong = ended
        elif error.count(b"\n") != (ended != "exit 0"):
            wrong = f"{ended} with {error.count(10)} lines on stderr"
        elif written:
            wrong = f"{ended} after writing {written[0].name}"
        return wrong + (": " + error[-300:].decode(errors="replace").strip() if wrong else ""), ended


def main():
    parser = argparse.ArgumentParser(description="Checks damaged input.")
    parser.add_argument("server")
    parser.add_argument("source", type=pathlib.Path)
    parser.add_argument("--of", choices=KINDS, default="scenes")
    parser.add_argument("--files", type=int, default=10000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0)
    options = parser.parse_args()

    # One rank that knows of no others starts no daemon.
    os.environ["OMPI_MCA_ess_singleton_isolated"] = "1"
    work = pathlib.Path("fuzz_work").absolute()
    findings = pathlib.Path("findings").absolute()
    for directory in (work, findings):
        shutil.rmtree(directory, ignore_errors=True)
        directory.mkdir()
    program = Program(os.path.abspath(options.server), work)
    kind = KINDS[options.of](options.source.absolute(), program, work)

    outcomes = collections.Counter()
    n_findings, start = 0, time.time()
    for number in range(options.first, options.first + options.files):
        file, arguments = kind.make(random.Random(f"{options.seed} {number}"))
        wrong, ended = program.run(*arguments, "--check")
        if not wrong and number % 10 == 0 and ended in kind.in_full:
            wrong, ended_again = program.run(*arguments, allowed=kind.in_full[ended])
            wrong = wrong and f"without --check: {wrong}"
        outcomes[ended] += 1
        if wrong:
            n_findings += 1
            kept = findings / f"{options.seed}_{number}{file.suffix}"
            shutil.copy(file, kept)
            print(f"{kept}: {wrong}", flush=True)
        if (number + 1) % 1000 == 0:
            print(f"{number + 1} files, {n_findings} findings, {time.time() - start:.0f} s", flush=True)
    print(f"{options.files} {options.of} of seed {options.seed}: {outcomes['exit 0']} accepted, "
          f"{outcomes['exit 1']} refused, {n_findings} findings")
    sys.exit(n_findings > 0)


main()
