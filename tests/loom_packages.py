# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""When ./loom installs missing packages, asks, or refuses, and how it counts tests. Usage, in a directory of its own:
loom_packages.py LOOM

Skipped where there are no terminals to be had, as in a chroot without /dev/pts. It gets a Debian, a user, apt, which
writes down what it is called with, cmake and ctest, all made of scripts.
"""

import os
import pty
import shutil
import subprocess
import sys
import tempfile

LOOM = sys.argv[1]
SCRIPTS = {
    "dpkg-query": '[[ $INSTALLED = all || " $INSTALLED " = *" ${!#} "* ]] && echo installed',
    "id": "echo $USER_ID",
    "sudo": 'exec "$@"',
    "apt-get": 'echo "$@" >> "$CALLS"',
    "cmake": 'mkdir -p "${0%/*}/build"',
    "build/fiberloom": 'echo "$OMP_NUM_THREADS $OMPI_ALLOW_RUN_AS_ROOT $*"',
    "mpirun": 'echo "mpirun $*"',
    "ctest": 'echo "$TESTED"; ! grep -q FAILED <<< "$TESTED"',
}
SKIPPED = 77
failures = 0


def build(*arguments, user=0, installed="g++ make", answer=None, tested=""):
    """Status, lines on stdout and on stderr, and what apt was told to install; `answer` is typed at a terminal."""
    with tempfile.TemporaryDirectory() as directory:
        for name, text in SCRIPTS.items():
            os.makedirs(os.path.dirname(os.path.join(directory, name)), exist_ok=True)
            with open(os.path.join(directory, name), "w") as script:
                script.write(f"#!/bin/bash\n{text}\n")
            os.chmod(script.name, 0o755)
        loom = shutil.copy(LOOM, directory)
        calls = os.path.join(directory, "calls")
        environment = {"PATH": directory + os.pathsep + os.environ["PATH"], "CALLS": calls, "USER_ID": str(user),
                       "INSTALLED": installed, "TESTED": tested}
        keyboard, terminal = pty.openpty()
        if answer is not None:
            os.write(keyboard, answer.encode())
        done = subprocess.run([loom, *arguments], env=environment, capture_output=True, text=True, timeout=60,
                              stdin=subprocess.DEVNULL if answer is None else terminal)
        os.close(keyboard)
        os.close(terminal)
        told = open(calls).read().split("--no-install-recommends")[-1].split() if os.path.exists(calls) else []
    return done.returncode, done.stdout, done.stderr.splitlines(), told


def check(what, good):
    global failures
    failures += not good
    print(f"{'ok   ' if good else 'WRONG'} {what}", flush=True)


def installs(*arguments, **options):
    status, _, errors, told = build(*arguments, **options)
    return status == 0 and not errors and "libdeal.ii-dev" in told and "g++" not in told


def refuses(*arguments, **options):
    status, _, errors, told = build(*arguments, **options)
    return status == 1 and len(errors) == 1 and "libdeal.ii-dev" in errors[0] and not told


def answered(answer, **options):
    status, shown, _, told = build("build", answer=answer, **options)
    return status == 0, "libdeal.ii-dev" in shown, "libdeal.ii-dev" in told


def counted(tested):
    """Status and last line or two of ./loom test, where ctest ends with these lines."""
    status, shown, _, _ = build("test", installed="all", tested=tested)
    lines = shown.splitlines()
    return status, "\n".join(lines[-2:] if "skipped" in lines[-2] else lines[-1:])


try:
    for end in pty.openpty():
        os.close(end)
except OSError as error:
    print(f"skipped: {error}")
    sys.exit(SKIPPED)

check("nothing to install: builds, also without a terminal",
      build("build", user=1000, installed="all")[::3] == (0, []))
check("root without a terminal: installs", installs("build"))
check("install: installs as well", installs("install"))
check("a user without a terminal: one line", refuses("build", user=1000))
for arguments in ("--yes", "build"), ("build", "--yes"), ("-y", "build"), ("build", "-y"):
    check(f"a user without a terminal, {' '.join(arguments)}: installs", installs(*arguments, user=1000))
for user in 0, 1000:
    check(f"user {user} at a terminal, y: told, installed", answered("y\n", user=user) == (True, True, True))
    check(f"user {user} at a terminal, return: told, installed", answered("\n", user=user) == (True, True, True))
    check(f"user {user} at a terminal, n: told, not installed", answered("n\n", user=user) == (False, True, False))
    check(f"user {user} at a terminal, end: told, not installed", answered("\x04", user=user) == (False, True, False))
check("at a terminal, --yes: not asked", installs("build", "--yes", answer="n\n"))
check("start: installs and builds nothing, sets the environment",
      build("start", "a.prm", "--ranks", "1", user=1000) == (0, "1 1 a.prm\n", [], []))
status, shown, errors, told = build("start", "a.prm", "--ranks", "2", user=1000)
check("start: on two ranks", status == 0 and shown.startswith("mpirun -q -np 2 ") and shown.endswith("/build/fiberloom a.prm\n")
      and not errors and not told)
check("run: would install", refuses("run", "a.prm", "--ranks", "1", user=1000))
check("all tests pass", counted("100% tests passed, 0 tests failed out of 5") == (0, "5 passed, 0 failed"))
check("one is skipped", counted("100% tests passed, 0 tests failed out of 5\n\nThe following tests did not run:\n"
                                "\t  2 - b (Skipped)") == (0, "1 skipped\n4 passed, 0 failed"))
check("one is skipped, two fail", counted("60% tests passed, 2 tests failed out of 5\n\nThe following tests did not run:\n"
                                          "\t  2 - b (Skipped)\n\nThe following tests FAILED:\n\t  3 - c (Failed)\n"
                                          "\t  4 - d (Not Run)") == (1, "1 skipped\n2 passed, 2 failed"))
sys.exit(failures > 0)
