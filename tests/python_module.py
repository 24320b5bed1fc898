#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors
"""The Python module by its own tests; skipped where pytest, pandas or matplotlib are not installed."""

import os
import subprocess
import sys

program, source = sys.argv[1:3]
needed = "import matplotlib, pandas, pytest"
# Debian's packages are those of its own interpreter.
for python in (sys.executable, "/usr/bin/python3"):
    if os.path.exists(python) and subprocess.run([python, "-c", needed], capture_output=True).returncode == 0:
        break
else:
    print("no pytest, pandas or matplotlib: apt-get install python3-pytest python3-pandas python3-matplotlib")
    sys.exit(77)
environment = dict(os.environ, FIBERLOOM=program, PYTHONPATH=os.path.join(source, "tools/python"))
sys.exit(subprocess.run([python, "-m", "pytest", "-q", "-p", "no:cacheprovider", "tools/python/tests"], cwd=source, env=environment).returncode)
