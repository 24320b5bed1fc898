# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""Tables and what is written into documents between two of their lines, or behind one."""

import os
import sys


def markdown_table(header, rows):
    return "\n".join("| " + " | ".join(row) + " |" for row in [header, ["---"] * len(header), *rows])


def block(file, begin, end=None):
    """What stands in front of `begin`, between it and `end`, and behind that."""
    with open(file) as document:
        before, found, rest = document.read().partition(begin)
    between, also_found, after = rest.partition(end) if end else (rest, True, "")
    if not (found and also_found):
        sys.exit(f"{file} has no line {end if found else begin}")
    return before, between, after


def replace_block(file, text, begin, end=None):
    before, _, after = block(file, begin, end)
    with open(file + ".new", "w") as document:
        document.write(f"{before}{begin}\n\n{text}\n" + (f"\n{end}{after}" if end else ""))
    os.replace(file + ".new", file)
