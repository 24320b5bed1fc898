#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""The power law of a fiber bed, P = a V^n, fitted to a compaction curve.

    power_law.py DIRECTORY [--least PART]

P is the pressure and V the fiber volume fraction of the stage compact in DIRECTORY/loading_curve.csv, on the way down
and from PART of the largest pressure on (0.05 unless given). The line is fitted to the logarithms; prints n with its
standard error, a, and the spread, by which factor pressures scatter about the law.
"""

import argparse
import csv
import math
import os
import statistics
import sys


def points(directory, least):
    """Fractions and pressures [MPa] of the way down."""
    with open(os.path.join(directory, "loading_curve.csv")) as file:
        rows = [(float(row["fiber_volume_fraction"]), float(row["pressure[MPa]"]))
                for row in csv.DictReader(file) if row["stage"] == "compact"]
    if rows:
        rows = rows[:rows.index(max(rows)) + 1]
    return [(fraction, pressure) for fraction, pressure in rows if pressure >= least * rows[-1][1] and pressure > 0]


def fit(data):
    """Exponent, its standard error, factor [MPa] and spread of the logarithm."""
    x, y = [math.log(fraction) for fraction, _ in data], [math.log(pressure) for _, pressure in data]
    exponent, offset = statistics.linear_regression(x, y)
    spread = math.sqrt(sum((b - offset - exponent * a) ** 2 for a, b in zip(x, y)) / (len(data) - 2))
    return exponent, spread / math.sqrt(len(data) * statistics.pvariance(x)), math.exp(offset), spread


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory")
    parser.add_argument("--least", type=float, default=.05)
    arguments = parser.parse_args()
    try:
        data = points(arguments.directory, arguments.least)
    except (OSError, KeyError) as error:
        sys.exit(f"{arguments.directory}: no compaction curve: {error}")
    if len(data) < 3:
        sys.exit(f"{arguments.directory}: {len(data)} points; at least 3 are needed")
    exponent, error, factor, spread = fit(data)
    print(f"n = {exponent:.2f} +- {error:.2f}, a = {factor:.4g} MPa, spread {100 * math.expm1(spread):.1f} %, "
          f"{len(data)} points from V = {data[0][0]:.3f} to {data[-1][0]:.3f}")


if __name__ == "__main__":
    main()
