# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""No function is longer than a screen or takes more parameters than one remembers.
Usage: function_sizes.py ROOT

It relies on the formatting of the sources, and is first tried on functions that are too large.
"""

import pathlib
import re
import sys

MOST_LINES, MOST_PARAMETERS = 80, 5

DECLARATOR = re.compile(r"^\s*(?:explicit )?(?:[\w~]+::)*(operator\(\)|[A-Za-z_~]\w*)\(", re.MULTILINE)
TYPE = r"(?:const )?(?:unsigned )?[\w:]+(?:<.*>)?(?:::\w+)?"
NAMED = re.compile(TYPE + r"[\s&*]+\w+(?: *=.*)?", re.DOTALL)
PARAMETER = re.compile(TYPE + r"(?:[\s&*]+(?:const[\s&*]+)*(?:\w+(?:\[\w*\])?)?(?: *=.*)?)?", re.DOTALL)
AFTER = re.compile(r"\s*(?:const\b|override\b|noexcept\b|[;{:=])")
BODY = re.compile(r"\s*(?:(?:const|override|noexcept|final)\s*)*(?:\{|:\s*\w+[({<])")


def without_comments(text):
    text = re.sub(r"/\*.*?\*/", lambda comment: "\n" * comment[0].count("\n"), text, flags=re.DOTALL)
    return re.sub(r"//[^\n]*", "", re.sub(r'"(\\.|[^"\\])*"', '""', text))


def arguments(text, start):
    """What is between the parenthesis that ends before `start` and its partner, at commas, where that ends, and whether
    angles in it are brackets."""
    found, depth, angles, begin = [], 1, 0, start
    for end in range(start, len(text)):
        sign = text[end]
        depth += (sign in "([{") - (sign in ")]}")
        angles += (sign == "<") - (sign == ">" and text[end - 1] != "-")
        if depth == 0 or (sign == "," and depth == 1 and angles <= 0):
            found.append(text[begin:end].strip())
            begin = end + 1
        if depth == 0:
            return found, end + 1, angles == 0
    return found, len(text), False


def too_many_parameters(text):
    """Those of a definition have to be readable; what has no body may be a call, unless all have types and names."""
    for match in DECLARATOR.finditer(text):
        parameters, end, readable = arguments(text, match.end())
        if not AFTER.match(text, end) or (readable and len(parameters) <= MOST_PARAMETERS):
            continue
        line, defined = text.count("\n", 0, match.start(1)) + 1, BODY.match(text, end)
        if readable and all(map((PARAMETER if defined else NAMED).fullmatch, parameters)):
            yield line, f"{match[1]} takes {len(parameters)} parameters"
        elif defined:
            yield line, f"parameters of {match[1]} cannot be read"


def too_long(text):
    """Functions whose braces stand alone, at the same place."""
    lines, open_at = text.splitlines(), {}
    for number, line in enumerate(lines, 1):
        indent = len(line) - len(line.lstrip())
        if line.strip() == "{":
            before = next((above for above in reversed(lines[:number - 1]) if above.strip()), "")
            if not re.match(r"\s*(namespace|class|struct|enum)\b", before) and indent <= 8:
                open_at[indent] = number
        elif line.strip() in ("}", "};") and indent in open_at:
            begin = open_at.pop(indent)
            if number - begin - 1 > MOST_LINES:
                yield begin, f"a body of {number - begin - 1} lines"


def complaints(text):
    text = without_comments(text)
    return [*too_many_parameters(text), *too_long(text)]


def try_on_large_ones():
    many = "  void\n  f(" + ",\n    ".join(f"const std::map<int, double> &p{i}" for i in range(6)) + ") const;\n"
    long = "namespace a\n{\n  int\n  g(int)\n  {\n" + "    // more\n" * 81 + "  }\n}\n"
    unnamed = "  void\n  S::operator()(int, char *a[], const char *const *b, double &&, T<U, V> c = {}, bool) const\n  {\n  }\n"
    unread = ("  int\n  k(int (*a)(int), int b, int c, int d, int e, int f)\n  {\n  }\n"
              "  K::K(int a = 1 << 2, int b = 1, int c = 1)\n    : a(a)\n  {\n  }\n")
    return ([what for _, what in complaints(many + long + unnamed + unread)] ==
            ["f takes 6 parameters", "operator() takes 6 parameters", "parameters of k cannot be read",
             "parameters of K cannot be read", "a body of 81 lines"] and
            not complaints("namespace b\n{\n" + "  int i;\n" * 99 + "}\n") and
            not complaints("  void\n  h(int a, int b, int c, int d, int e);\n  x = h(1, 2, 3, 4, 5, 6);\n"
                           "  h(1, 2, 3, 4, 5, 6 < 7);\n"))


root = pathlib.Path(sys.argv[1])
files = sorted(file for top in ("include", "source") for file in (root / top).rglob("*") if file.suffix in (".h", ".cc"))
wrong = [f"{file.relative_to(root)}:{line}: {what}" for file in files for line, what in complaints(file.read_text())]
if not try_on_large_ones():
    wrong.append("functions that are too large pass")
if len(files) < 100:
    wrong.append("where are the sources?")
print(*wrong, f"{len(files)} files read, {len(wrong)} wrong", sep="\n")
sys.exit(bool(wrong))
