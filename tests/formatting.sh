#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

# Every source file is as clang-format leaves it. Usage, from the top:
# tests/formatting.sh CLANG_FORMAT

set -eu

if printf 'int  main( ){}\n' |
    "$1" --dry-run -Werror --assume-filename=source/main.cc 2>/dev/null; then
  echo "$1 does not notice a file that is badly formatted."
  exit 1
fi
# A pipe would pass on nothing of what find cannot read.
files=$(mktemp)
trap 'rm -f "$files"' EXIT
find include source tests \( -name '*.h' -o -name '*.cc' \) -print0 > "$files"
if [ ! -s "$files" ]; then
  echo "Where are the sources?"
  exit 1
fi
xargs -0 "$1" --dry-run -Werror < "$files"
