# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""Damaged scenes: each is accepted, or refused in one line with nothing written.

    fuzz.py FORK_SERVER SOURCE_DIRECTORY [--files N] [--seed S] [--first I]

Takes all scenes of the source directory, changes each copy in a few places, and
lets the program check it within limits of time and memory. Every tenth, if it is
refused, goes through the program a second time without --check. Allowed are
status 0, and status 1 with one line on stderr, both without a trace in the working
directory. Everything else is a finding: its file is kept in `findings/` and
named. File number I of a seed is always the same: `--first I --files 1` makes it again.
"""

import argparse
import collections
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import time

# The largest scene takes 2 s and 0.5 GB.
SECONDS, MEGABYTES = 60, 4000

NUMBERS = ["1e308", "-1e308", "1e-308", "5e-324", "1e400", "-1", "0", "-0", "nan", "inf", "-inf", "", "0x10", "1e",
           "2147483647", "2147483648", "-2147483649", "4294967296", "18446744073709551616", "9" * 400, "1.5", "0.3",
           "1", "2", "3", "7", "1000", "10000", "1000000", "1e-9", "1e9", "1,5", "1 2", "one", "true", "none", "both"]
FUNCTIONS = ["(", ")", "((t)", "1/t", "t^", "sqrt(-1)", "log(t)", "foo(t)", "t; t", "; ; ", "if(t<0.5,0,3)", "1e308*t",
             "exp(1e9*t)", "rand()", "t=2", "s", "i", "x", "\"t\"", "0; 0; 0", "t; 0; 0; 0", "pi*s; i; 0", "(" * 5000,
             "1+" * 5000 + "t", "t?1:0", "t?:", "1e-300^2", "rand_seed(1)", "erfc(t)", "\\t", "%", "$t", "0; 0; t | 0"]
LISTS = [",", ",,", "1,", "a, b", "0 start", "all end", "0 at 0.5", "0-99999999999 end", "5-2 start", "-1 end",
         "all at nan", "weave", "load", "coat, coat", "weave, coat, bend", "0 0 0, 1 0 0", "0 0 0", "0 0 0, 0 0 0",
         "1 2, 3 4", "0 0 0, 1 0 0; 0 0 0, 1 0 0", "0 0 0, 1e308 0 0", "0 0 0, 1e-300 0 0", "1, 2, 3", "101 010",
         "twill 2/2", "satin 8", "1" * 2000, "0/1", "x y z", "rx ry rz", "z spin tilt radial"]
BYTES = [b"\x00", b"\xff", b"\xfe\xff", b"\xc3\x28", b"\x80", b"\r", b"\t", b"\\", b"#", b"=", b"|", b"<", b">",
         b"%s%n", b"\xe2\x80\xa8", b"\x1b[31m", b"'", b'"', b";", b"{", b"$(ls)", b"\n", b" "]
LINES = [b"set Foo = 1", b"set Tows", b"set = 1", b"set", b"subsection", b"subsection Foo", b"end", b"\\", b"#",
         b"subsection Fabric", b"include other.prm", b"set A = \\", b"set Drives = a, b", b"subsection Drive a",
         b"set Stages =", b"set Stages = weave, coat, shear, bend", b"SET Accuracy = fine", b"END", b"subsection Warp",
         b"set set set", b"set Drives = ", b"set Accuracy == draft", b"set Line <99999999999999999999> = 1"]
SET = re.compile(rb"(\s*set\s+[^=]*=)\s*(.*)", re.IGNORECASE | re.DOTALL)


class Mutator:
    """Changes a scene, a list of lines, in one place of its choice."""

    def __init__(self, rng, entries, donors):
        self.rng, self.entries, self.donors = rng, entries, donors

    def value(self):
        return self.rng.choice(self.rng.choice([NUMBERS, NUMBERS, FUNCTIONS, LISTS])).encode()

    def place(self, lines):
        return self.rng.randrange(len(lines))

    def assignment(self, lines):
        """A line that sets an entry, or any if there is none."""
        places = [i for i, line in enumerate(lines) if SET.match(line)]
        return self.rng.choice(places) if places else self.place(lines)

    def change_bytes(self, lines):
        i = self.place(lines)
        line = lines[i]
        at = self.rng.randrange(len(line) + 1)
        one = line[at:at + 1]
        lines[i] = line[:at] + self.rng.choice(
            [b"", one + one, self.rng.choice(BYTES), bytes([self.rng.randrange(256)]) + one]) + line[at + 1:]

    def change_lines(self, lines):
        i, j = self.place(lines), self.place(lines)
        kind = self.rng.randrange(5)
        if kind == 0:
            del lines[i]
        elif kind == 1:
            lines.insert(j, lines[i])
        elif kind == 2:
            lines[i], lines[j] = lines[j], lines[i]
        elif kind == 3:
            lines.insert(i, self.rng.choice(LINES))
        else:
            del lines[min(i, j):max(i, j)]

    def set_value(self, lines):
        i = self.assignment(lines)
        match = SET.match(lines[i])
        if match:
            lines[i] = match[1] + b" " + self.value()

    def set_number(self, lines):
        """One number within a value."""
        i = self.assignment(lines)
        numbers = list(re.finditer(rb"\d+(\.\d+)?", lines[i]))
        if numbers:
            at = self.rng.choice(numbers)
            scaled = str(self.rng.choice([1, 2, 3, 5, 20, 300, 10000])) if at[0].isdigit() else \
                str(float(at[0]) * 10 ** self.rng.uniform(-6, 6))
            number = self.rng.choice([scaled, scaled, self.rng.choice(NUMBERS)]).encode()
            lines[i] = lines[i][:at.start()] + number + lines[i][at.end():]

    def swap_values(self, lines):
        i, j = self.assignment(lines), self.assignment(lines)
        first, second = SET.match(lines[i]), SET.match(lines[j])
        if first and second:
            lines[i], lines[j] = first[1] + b" " + second[2], second[1] + b" " + first[2]

    def change_list(self, lines):
        i = self.assignment(lines)
        match = SET.match(lines[i])
        if not match:
            return
        sign = self.rng.choice([b",", b";", b" "])
        parts = match[2].split(sign)
        at = self.rng.randrange(len(parts))
        parts[at:at + 1] = self.rng.choice([[], 2 * [parts[at]], 300 * [parts[at]], [b""], [parts[at], self.value()]])
        lines[i] = match[1] + b" " + sign.join(parts)

    def break_function(self, lines):
        i = self.assignment(lines)
        at = self.rng.randrange(len(lines[i]) + 1)
        lines[i] = lines[i][:at] + self.rng.choice(FUNCTIONS).encode() + lines[i][at:]

    def add_entry(self, lines):
        """Any entry of the program, with a value of its own or a foreign one."""
        sections, name, value = self.rng.choice(self.entries)
        value = self.rng.choice([value, self.value(), self.rng.choice(self.rng.choice(self.donors))[2]])
        lines += [b"subsection " + section for section in sections]
        lines += [b"set " + name + b" = " + value] + len(sections) * [b"end"]

    def lengthen(self, lines):
        i = self.place(lines)
        times = self.rng.choice([100, 10000, 200000])
        at = self.rng.randrange(len(lines[i]) + 1)
        lines[i] = lines[i][:at] + self.rng.choice([b"a", b"1", b" ", b"#", b"(", b", 1", b"; t", b"\xff"]) * times + \
            lines[i][at:]

    def nest(self, lines):
        sections = self.rng.choice([2, 100, 3000]) * [b"subsection Fabric"]
        i = self.place(lines)
        lines[i:i] = sections + self.rng.choice([[], len(sections) * [b"end"]])

    def join(self, lines):
        sign = self.rng.choice([b"\\", b"\r", b" "])
        for i in range(self.place(lines), len(lines)):
            lines[i] += sign

    def mutate(self, lines):
        often = [self.change_bytes, self.change_lines, self.set_value, self.set_number, self.set_number,
                 self.swap_values, self.change_list, self.break_function, self.add_entry]
        rare = [self.lengthen, self.nest, self.join]
        # Several changes hide each other where the first is refused.
        for _ in range(self.rng.choice([1, 1, 1, 1, 2, 3, 6])):
            if not lines:
                lines.append(b"")
            self.rng.choice(4 * often + rare)(lines)
        return lines


def entries_of(text):
    """(sections, name, value) of all entries of a scene."""
    sections, found = [], []
    for line in text.split(b"\n"):
        match = SET.match(line)
        if line.split()[:1] == [b"subsection"]:
            sections = sections + [line.split(None, 1)[1]]
        elif line.split() == [b"end"]:
            sections = sections[:-1]
        elif match:
            found.append((sections, match[1].split(None, 1)[1][:-1].strip(), match[2].strip()))
    return found


def self_contained(text):
    """What starts from a woven state is read as if it wove the fabric itself."""
    if b"subsection Fibers" in text or re.search(rb"^set Stages\s*=.*weave", text, re.MULTILINE):
        return text
    return re.sub(rb"^(set Stages\s*=) ", rb"\1 weave, ", text, flags=re.MULTILINE)


class Program:
    """Runs the program in `work/here`, which has to stay empty."""

    def __init__(self, server, work):
        self.work = work
        self.here = work / "here"
        self.here.mkdir()
        self.server = subprocess.Popen([server, str(SECONDS), str(MEGABYTES)], cwd=self.here, stdin=subprocess.PIPE,
                                       stdout=subprocess.PIPE, text=True)

    def run(self, *arguments):
        """(what is wrong or "", status)."""
        self.server.stdin.write("\t".join(arguments) + "\n")
        self.server.stdin.flush()
        ended = self.server.stdout.readline().strip()
        error = (self.work / "err").read_bytes()
        written = list(self.here.iterdir())
        for path in written:
            shutil.rmtree(path) if path.is_dir() else path.unlink()
        wrong = ""
        if ended not in ("exit 0", "exit 1"):
            wrong = ended
        elif error.count(b"\n") != (ended == "exit 1"):
            wrong = f"{ended} with {error.count(10)} lines on stderr"
        elif written:
            wrong = f"{ended} after writing {written[0].name}"
        return wrong + (": " + error[-300:].decode(errors="replace").strip() if wrong else ""), ended


def main():
    parser = argparse.ArgumentParser(description="Checks damaged scenes.")
    parser.add_argument("server")
    parser.add_argument("source", type=pathlib.Path)
    parser.add_argument("--files", type=int, default=10000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0)
    options = parser.parse_args()

    # One rank that knows of no others starts no daemon.
    os.environ["OMPI_MCA_ess_singleton_isolated"] = "1"
    scenes = sorted((options.source / "prm").rglob("*.prm")) + sorted((options.source / "tests").rglob("*.prm"))
    texts = [self_contained(scene.read_bytes()) for scene in scenes]
    # Those of the paper have 300,000 dofs, and nothing that the others do not have.
    weights = [.02 if "paper" in scene.parts else 1 for scene in scenes]
    work = pathlib.Path("fuzz_work").absolute()
    findings = pathlib.Path("findings").absolute()
    for directory in (work, findings):
        shutil.rmtree(directory, ignore_errors=True)
        directory.mkdir()
    program = Program(os.path.abspath(options.server), work)
    file = work / "scene.prm"

    wrong, _ = program.run("--print-parameters")
    entries = entries_of((work / "out").read_bytes())
    if wrong or len(entries) < 100:
        sys.exit(f"--print-parameters: {wrong or 'too few entries'}")
    outcomes = collections.Counter()
    n_findings, start = 0, time.time()
    donors = [entries_of(text) for text in texts]
    for number in range(options.first, options.first + options.files):
        rng = random.Random(f"{options.seed} {number}")
        lines = rng.choices(texts, weights)[0].split(b"\n")
        file.write_bytes(b"\n".join(Mutator(rng, entries, donors).mutate(lines)))
        wrong, ended = program.run(str(file), "--check")
        if ended == "exit 1" and not wrong and number % 10 == 0:
            wrong, ended_again = program.run(str(file))
            if ended_again != ended:
                wrong = f"refused only by --check: {wrong or ended_again}"
        outcomes[ended] += 1
        if wrong:
            n_findings += 1
            kept = findings / f"{options.seed}_{number}.prm"
            shutil.copy(file, kept)
            print(f"{kept}: {wrong}", flush=True)
        if (number + 1) % 1000 == 0:
            print(f"{number + 1} files, {n_findings} findings, {time.time() - start:.0f} s", flush=True)
    print(f"{options.files} files of seed {options.seed}: {outcomes['exit 0']} accepted, {outcomes['exit 1']} refused, "
          f"{n_findings} findings")
    sys.exit(n_findings > 0)


main()
