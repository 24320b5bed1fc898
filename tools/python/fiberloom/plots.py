# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors
"""Curves of one run or of a sweep."""

from .results import Results


def plot(runs, x, y, *, stage=-1, axes=None):
    """Draws the columns ``y`` over ``x`` of the loading curve, and returns matplotlib's axes.

    ``stage`` is a name or a place in the list of stages, by default the last one.
    ``runs`` are Results, or a sweep, of which each run has a line with its values; a band shows the estimated error.
    """
    import matplotlib.pyplot as pyplot
    if axes is None:
        _, axes = pyplot.subplots()
    for values, results in [({}, runs)] if isinstance(runs, Results) else runs:
        if not isinstance(results, Results):
            continue
        curve = results.curve(stage)
        label = ", ".join(f"{entry.rpartition('/')[2]} {value}" for entry, value in values.items())
        line, = axes.plot(curve[x], curve[y], marker=".", label=label or None)
        error = results.error(stage)
        if error:
            band = error * curve[y].abs().max()
            axes.fill_between(curve[x], curve[y] - band, curve[y] + band, color=line.get_color(), alpha=.2, linewidth=0)
    axes.set_xlabel(x.replace("_", " "))
    axes.set_ylabel(y.replace("_", " "))
    if axes.get_legend_handles_labels()[0]:
        axes.legend()
    return axes
