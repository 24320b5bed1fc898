# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""The places that name the version agree. Usage: versions.py ROOT"""

import pathlib
import re
import sys

PLACES = {"CMakeLists.txt": r"^project\(fiberloom VERSION (\S+)",
          "CITATION.cff": r"^version: (\S+)$",
          "tools/python/fiberloom/__init__.py": r'^__version__ = "(.+)"$',
          "doc/changes.md": r"^## (\S+)"}

root = pathlib.Path(sys.argv[1])
found = {}
for file, pattern in PLACES.items():
    match = re.search(pattern, (root / file).read_text(), re.MULTILINE)
    found[file] = match[1] if match else None
    print(f"{file}: {found[file]}")
sys.exit(None in found.values() or len(set(found.values())) > 1)
