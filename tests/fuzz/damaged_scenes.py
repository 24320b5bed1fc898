# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""All scenes of the source directory, changed in a few places."""

import re
import sys

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


class Scenes:
    """Makes damaged scenes; see Fibers and Checkpoints for the others."""

    # What runs without --check, by how it ended with it, and how it may end then.
    in_full = {"exit 1": ("exit 1",)}

    def __init__(self, source, program, work):
        scenes = sorted((source / "prm").rglob("*.prm")) + sorted((source / "tests").rglob("*.prm"))
        self.texts = [self_contained(scene.read_bytes()) for scene in scenes]
        # Those of the paper have 300,000 dofs, and nothing that the others do not have.
        self.weights = [.02 if "paper" in scene.parts else 1 for scene in scenes]
        self.donors = [entries_of(text) for text in self.texts]
        self.file = work / "scene.prm"
        wrong, _ = program.run("--print-parameters")
        self.entries = entries_of((work / "out").read_bytes())
        if wrong or len(self.entries) < 100:
            sys.exit(f"--print-parameters: {wrong or 'too few entries'}")

    def make(self, rng):
        """The file, and the arguments of the program that reads it."""
        lines = rng.choices(self.texts, self.weights)[0].split(b"\n")
        self.file.write_bytes(b"\n".join(Mutator(rng, self.entries, self.donors).mutate(lines)))
        return self.file, [str(self.file)]
