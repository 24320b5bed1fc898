#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

# The parameter reference is what the program writes. Usage, from the top:
# tests/parameter_reference.sh PROGRAM REFERENCE

set -eu

written=$(mktemp)
trap 'rm -f "$written"' EXIT
"$1" --print-reference > "$written"
diff -u "$2" "$written" || {
  echo "Bring it up to date with: $1 --print-reference > $2"
  exit 1
}
