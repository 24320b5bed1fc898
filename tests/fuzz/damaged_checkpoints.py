# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""Checkpoints of a weave, of a fabric in a matrix and of fibers under way, changed in a few places; sizes and checksums
are made to fit."""

import math
import shutil
import struct
import zlib

DOUBLES = [0., -0., 1., -1., math.nan, math.inf, -math.inf, 1e300, -1e300, 1e-300, 1e7, 1e20, .5, 2.]
WHOLE = [0, 1, 2, 3, 7, 100, 1 << 16, (1 << 31) - 1, 1 << 31, (1 << 32) - 1, 1 << 33, 1 << 40, 1 << 62, (1 << 63) - 1,
         1 << 63, (1 << 64) - 1]

# Scene, settings that make the checkpoint, how that ends, and those of the run that starts from it. The third one stops
# where its drive has no place to go.
SEEDS = [
    ("small_weave.prm", ["Stages=weave"], "exit 0", ["Stages=weave, relax"]),
    ("small_weave.prm", ["Stages=weave, coat", "Matrix/Layers=both"], "exit 0",
     ["Stages=weave, coat, biaxial", "Matrix/Layers=both", "Biaxial/Largest strain=0.001"]),
    ("turning_fibers.prm", ["Load/First step=0.0237", "Load/Largest step=0.0237", "Load/End=1",
                            "Drive upper/Translation=0; 0; -0.01*t + if(abs(t - 0.4029) < 1e-5, 1/0, 0)"], "exit 2",
     ["Drive upper/Translation=0; 0; -0.01*t", "Load/First step=0.1", "Load/Largest step=0.1"])]

# From a spoilt state all that a run may try could take a minute.
SHORT = ["Solver/Largest cuts=1", "Solver/Largest loop iterations=20", "Solver/Error estimate=false"]


class Checkpoints:
    """Makes damaged checkpoints, each with the scene that it is of."""

    # What runs without --check, by how it ended with it, and how it may end then: from a spoilt state there need not
    # be a way.
    in_full = {"exit 0": ("exit 0", "exit 1", "exit 2")}

    def __init__(self, source, program, work):
        self.file, self.run = work / "checkpoint", work / "run"
        self.seeds = []
        for scene, before, expected, after in SEEDS:
            path = str(source / "tests/scenes" / scene)
            wrong, ended = program.run(path, *self.settings(before), allowed=(expected,))
            if wrong:
                raise SystemExit(f"no checkpoint of {scene}: {ended} {wrong}")
            self.seeds.append(((self.run / "checkpoint").read_bytes(), path, after))

    def settings(self, entries):
        shutil.rmtree(self.run, ignore_errors=True)
        words = ["--output-directory", str(self.run)]
        for entry in entries:
            words += ["--set", entry]
        return words

    @staticmethod
    def place(rng, body):
        """Lists and what is not a dof stand behind the long vectors, their lengths before them."""
        start, end = rng.choice([(0, len(body)), (0, 300), (len(body) // 2, len(body)), (len(body) - 2000, len(body))])
        return min(len(body) - 1, rng.randrange(max(0, start), end))

    def mutate(self, rng, body):
        at = self.place(rng, body)
        kind = rng.randrange(8)
        if kind == 0:
            return body[:at] + bytes([body[at] ^ 1 << rng.randrange(8)]) + body[at + 1:]
        if kind == 1:
            return body[:at] + bytes([rng.randrange(256)]) + body[at + 1:]
        if kind in (2, 3):
            return body[:at] + struct.pack("<d", rng.choice(DOUBLES)) + body[at + 8:]
        if kind in (4, 5):
            size = rng.choice([1, 2, 4, 8])
            return body[:at] + (rng.choice(WHOLE) % (1 << 8 * size)).to_bytes(size, "little") + body[at + size:]
        length = rng.choice([1, 4, 8, 100])
        other = self.place(rng, body)
        if kind == 6:
            return body[:at] + body[other:other + length] + body[at + length:]
        return rng.choice([body[:at], body[:at] + body[at + length:], body[:at] + body[other:other + length] + body[at:]])

    def make(self, rng):
        """The file, and the arguments of the program that starts from it."""
        content, scene, settings = rng.choice(self.seeds)
        start = content.index(b"\n") + 1  # then format, size, checksum
        body = content[start + 24:]
        for _ in range(rng.choice([1, 1, 1, 2, 3])):
            body = self.mutate(rng, body) or b"\0"
        self.file.write_bytes(content[:start + 8] + struct.pack("<QQ", len(body), zlib.crc32(body)) + body)
        return self.file, [scene, "--restart", str(self.file), *self.settings(settings + SHORT)]
