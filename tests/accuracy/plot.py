# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""Errors over seconds, both logarithmic, as a picture."""

import math
from xml.sax.saxutils import escape

COLORS = ("#1f77b4", "#ff7f0e", "#2ca02c", "#9467bd", "#8c564b", "#e377c2", "#17becf", "#bcbd22", "#7f7f7f", "#d62728")
WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 760, 460, 70, 220, 30, 50


def front(points):
    """Those (seconds, error) than which no other is both cheaper and better, cheapest first."""
    best, kept = math.inf, []
    for point in sorted(points):
        if point[1] < best:
            best = point[1]
            kept.append(point)
    return kept


class Axis:
    """Logarithms of values to places, from the ticks 1, 2, 5 below to those above."""

    def __init__(self, values, start, end):
        decades = range(math.floor(math.log10(min(values))) - 1, math.ceil(math.log10(max(values))) + 2)
        ticks = [digit * 10. ** decade for decade in decades for digit in (1, 2, 5)]
        low, high = max(t for t in ticks if t < min(values)), min(t for t in ticks if t > max(values))
        self.ticks = [t for t in ticks if low <= t <= high]
        if len(self.ticks) > 9:
            self.ticks = [t for t in self.ticks if abs(math.log10(t) - round(math.log10(t))) < 1e-9]
        self.low, self.scale, self.start = math.log10(low), (end - start) / math.log10(high / low), start

    def __call__(self, value):
        return self.start + self.scale * (math.log10(value) - self.low)


def picture(title, series, cost="CPU seconds", comparable=True):
    """`series` has for each name its points (seconds, error), of the same number if they are comparable."""
    points = [point for line in series.values() for point in line]
    x = Axis([p[0] for p in points], LEFT, WIDTH - RIGHT)
    y = Axis([100 * p[1] for p in points], HEIGHT - BOTTOM, TOP)
    place = lambda point: f"{x(point[0]):.1f},{y(100 * point[1]):.1f}"
    text = lambda x, y, words, more="": f'<text x="{x:.1f}" y="{y:.1f}" {more}>{escape(words)}</text>'
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" '
           f'font-size="12">', f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
           text(LEFT, TOP - 10, title, 'font-weight="bold"')]
    for tick in x.ticks:
        out.append(f'<path stroke="#ddd" d="M{x(tick):.1f},{TOP}V{HEIGHT - BOTTOM}"/>')
        out.append(text(x(tick), HEIGHT - BOTTOM + 18, f"{tick:g}", 'text-anchor="middle"'))
    for tick in y.ticks:
        out.append(f'<path stroke="#ddd" d="M{LEFT},{y(tick):.1f}H{WIDTH - RIGHT}"/>')
        out.append(text(LEFT - 8, y(tick) + 4, f"{tick:g}", 'text-anchor="end"'))
    out.append(text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 10, cost, 'text-anchor="middle"'))
    middle = (TOP + HEIGHT - BOTTOM) / 2
    out.append(text(16, middle, "error [%]", f'text-anchor="middle" transform="rotate(-90 16 {middle})"'))
    if comparable:
        out.append('<polyline fill="none" stroke="black" stroke-width="4" stroke-opacity="0.25" points="'
                   + " ".join(map(place, front(points))) + '"/>')
    for number, (name, line) in enumerate(series.items()):
        color = COLORS[number % len(COLORS)]
        if name not in ("levels", "one of them", "together"):
            out.append(f'<polyline fill="none" stroke="{color}" points="' + " ".join(map(place, line)) + '"/>')
        size = 6 if name == "levels" else 3.5
        out += [f'<circle cx="{x(a):.1f}" cy="{y(100 * b):.1f}" r="{size}" fill="{color}"/>' for a, b in line]
        height = TOP + 14 + 20 * number
        out.append(f'<circle cx="{WIDTH - RIGHT + 20}" cy="{height - 4}" r="{size}" fill="{color}"/>')
        out.append(text(WIDTH - RIGHT + 32, height, name))
    if comparable:
        height = TOP + 14 + 20 * len(series)
        out.append('<path stroke="black" stroke-width="4" stroke-opacity="0.25" '
                   f'd="M{WIDTH - RIGHT + 10},{height - 4}h20"/>')
        out.append(text(WIDTH - RIGHT + 36, height, "Pareto front"))
    return "\n".join(out + ["</svg>", ""])
